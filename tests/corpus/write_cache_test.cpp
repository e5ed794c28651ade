#include "corpus/write_cache.hpp"

#include "tool/tool_error.hpp"

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>

namespace tvg::corpus {
namespace {

class WriteCache : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string contents(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      ("tvg_write_cache_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  const Sequence sequence_{
      {3, {{0, 1, 2}}}, {{0, 0, 0, 1, 0.1F, 0, 0, -2.5F, 1e-7F}, {9, 8, 7, 6, 5, 4, 3, 2, 1}}, {}};
};

TEST_F(WriteCache, ObjHasTheFirstFrameAndCountsFromOne) {
  write_obj(path("t.obj"), sequence_);
  EXPECT_EQ(contents("t.obj"), "v 0 0 0\nv 1 0.1 0\nv 0 -2.5 1e-07\nf 1 2 3\n");
}

TEST_F(WriteCache, Pc2HasEveryFrameAfterItsHeader) {
  write_pc2(path("t.pc2"), sequence_);
  const std::string bytes = contents("t.pc2");
  ASSERT_EQ(bytes.size(), 32U + 2 * 36U);
  EXPECT_EQ(bytes.substr(0, 12), std::string("POINTCACHE2\0", 12));
  const std::string fields("\1\0\0\0\3\0\0\0\0\0\0\0\0\0\x80\x3f\2\0\0\0", 20);
  EXPECT_EQ(bytes.substr(12, 20), fields);
  // -2.5 is the eighth coordinate of the first frame, 9 the first of the second.
  EXPECT_EQ(bytes.substr(32 + 7 * 4, 4), std::string("\0\0\x20\xc0", 4));
  EXPECT_EQ(bytes.substr(32 + 9 * 4, 4), std::string("\0\0\x10\x41", 4));
}

TEST_F(WriteCache, SkeletonIsJson) {
  write_skeleton(path("s.json"), {{{"root", "end"}, {-1, 0}, {}}, {{0, 0, 0, 1, 0.5F, 0}}});
  EXPECT_EQ(contents("s.json"),
            "{\"frames\":[[[0.0,0.0,0.0],[1.0,0.5,0.0]]],"
            "\"joints\":[{\"name\":\"root\",\"parent\":null},{\"name\":\"end\",\"parent\":0}]}\n");
}

TEST_F(WriteCache, ComplainsWhereAFileCannotBeWritten) {
  EXPECT_THROW(write_pc2(path("no/such/folder/t.pc2"), sequence_), cli::ToolError);
}

}  // namespace
}  // namespace tvg::corpus
