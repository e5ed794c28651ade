#include "tool/atomic_folder.hpp"

#include "tests/importers/io_toolbox.hpp"
#include "tool/tool_error.hpp"

#include <gtest/gtest.h>

namespace tvg::cli::testing {
namespace {

using Names = std::vector<std::string>;

TEST(AtomicFolder, ShowsNoFileBeforeAllAreComplete) {
  const TemporaryFolder home;
  AtomicFolder folder(home.path("a/b"));
  folder.add("one", "1");
  folder.add("two").write("2");
  EXPECT_FALSE(std::filesystem::exists(home.path("a/b/one")));
  folder.finish();
  EXPECT_EQ(home.read("a/b/one") + home.read("a/b/two"), "12");
}

TEST(AtomicFolder, LeavesNothingWhereItIsNotFinished) {
  const TemporaryFolder home;
  { AtomicFolder(home.path("a/b")).add("one", "1"); }
  EXPECT_EQ(home.names(), Names{});
  home.write("there/mine", "mine");
  { AtomicFolder(home.path("there")).add("mine", "other"); }
  EXPECT_EQ(home.read("there/mine"), "mine");
  EXPECT_EQ(home.names(), Names{"there"});
}

TEST(AtomicFolder, IsNoFile) {
  const TemporaryFolder home;
  home.write("file", "");
  for (const char* path : {"file", "file/below"}) {
    try {
      AtomicFolder folder(home.path(path));
      ADD_FAILURE() << path;
    } catch (const ToolError& error) {
      EXPECT_EQ(error.status(), ExitStatus::kIo);
    }
  }
}

}  // namespace
}  // namespace tvg::cli::testing
