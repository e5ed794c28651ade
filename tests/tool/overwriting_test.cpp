#include "tool/overwriting.hpp"

#include "tests/importers/io_toolbox.hpp"
#include "tool/tool_error.hpp"

#include <filesystem>
#include <gtest/gtest.h>

namespace tvg::cli::testing {
namespace {

TEST(DefaultOutput, IsNamedAfterTheInputBesideIt) {
  EXPECT_EQ(default_output("walk.obj", ".tvg"), "walk.tvg");
  EXPECT_EQ(default_output("shots/a.b/walk.glb", ".tvg"), "shots/a.b/walk.tvg");
  EXPECT_EQ(default_output("walk.tvg", "_decoded.pc2"), "walk_decoded.pc2");
}

TEST(DefaultOutput, OfASequenceIsWhatItsFilesShare) {
  EXPECT_EQ(default_output("walk_%04d.obj", ".tvg"), "walk.tvg");
  EXPECT_EQ(default_output("shots/walk.####.ply", ".tvg"), "shots/walk.tvg");
  EXPECT_EQ(default_output("shots/%04d/mesh.obj", ".tvg"), "shots.tvg");
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("walk.v2"));
  EXPECT_EQ(default_output(folder.path("walk.v2"), ".tvg"), folder.path("walk.v2.tvg"));
  EXPECT_EQ(default_output(folder.path("walk.v2/"), ".tvg"), folder.path("walk.v2.tvg"));
}

TEST(DefaultOutput, OfAnAddressIsItsLastPartHere) {
  EXPECT_EQ(default_output("http://localhost/shots/walk.tvg?key=1", "_decoded.pc2"), "walk_decoded.pc2");
}

TEST(DefaultOutput, OfAPipeThereIsNone) {
  EXPECT_THROW(default_output("-", ".tvg"), ToolError);
}

}  // namespace
}  // namespace tvg::cli::testing
