#include "encoder/importers/open_source.hpp"
#include "tests/importers/sample_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sys/stat.h>

namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;

class CacheSource : public ::testing::Test {
 protected:
  OpenedSource open(const std::string& cache_bytes, const std::string& name = "t.pc2",
                    std::optional<FrameRange> frames = {}) {
    return open_source({{mesh_, folder_.write(name, cache_bytes)}, frames});
  }
  ToolError refusal(const std::string& cache_bytes, const std::string& name = "t.pc2") {
    return thrown_by([&] { open(cache_bytes, name); });
  }

  TemporaryFolder folder_;
  std::string mesh_ = folder_.write("t.obj", sample_obj());
};

/// Standard input read from a file or a pipe for as long as it lives.
class StandardInput {
 public:
  explicit StandardInput(const std::string& bytes) : saved_(dup(STDIN_FILENO)) {
    int ends[2];
    if (pipe(ends) != 0) std::abort();
    // Test inputs are smaller than a pipe's buffer, so no second thread has to write.
    if (write(ends[1], bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) std::abort();
    close(ends[1]);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
  }
  ~StandardInput() {
    dup2(saved_, STDIN_FILENO);
    close(saved_);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;

 private:
  int saved_;
};

TEST_F(CacheSource, ReadsPc2AndMddFrameByFrameAndRewinds) {
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"t.pc2", pc2_bytes(4, 5, 5)},
                                    {"t.mdd", mdd_bytes(4, 5, 5, 1 / 24.0)}}) {
    const OpenedSource opened = open(bytes, name);
    EXPECT_EQ(opened.source->frame_count(), 5U);
    EXPECT_EQ(opened.source->mesh().faces, kTetrahedron);
    for (int pass = 0; pass < 2; ++pass) {
      const Frames result = read_all(*opened.source);
      EXPECT_FALSE(result.error);
      ASSERT_EQ(result.frames.size(), 5U);
      for (std::size_t frame = 0; frame < 5; ++frame)
        EXPECT_EQ(result.frames[frame], tetrahedron_positions(frame));
      EXPECT_TRUE(opened.source->rewind());
    }
  }
}

TEST_F(CacheSource, DerivesFpsFromEvenMddTimesOnly) {
  const auto fps = [&](const std::string& bytes, const std::string& name) {
    const Metadata metadata = open(bytes, name).source->metadata();
    const auto entry = metadata.find("fps");
    return entry == metadata.end() ? std::string() : entry->second;
  };
  EXPECT_EQ(fps(mdd_bytes(4, 100, 100, 1 / 24.0), "t.mdd"), "24");
  EXPECT_EQ(fps(mdd_bytes(4, 1000, 1000, 1.001 / 30), "t.mdd"), "30000/1001");
  EXPECT_EQ(fps(mdd_bytes(4, 100, 100, 0.08), "t.mdd"), "12500/1000");
  EXPECT_EQ(fps(mdd_bytes(4, 100, 100, 1), "t.mdd"), "");
  EXPECT_EQ(fps(mdd_bytes(4, 1, 1, 0), "t.mdd"), "");
  std::string uneven = mdd_bytes(4, 100, 100, 1 / 24.0);
  uneven[8 + 4 * 50] = 'B';
  EXPECT_EQ(fps(uneven, "t.mdd"), "");
  EXPECT_EQ(fps(pc2_bytes(4, 3, 3), "t.pc2"), "");
  EXPECT_EQ(open(pc2_bytes(4, 3, 3)).source->metadata().at("name"), "thing");
}

TEST_F(CacheSource, NamesThePlaceWhereACutFileEnds) {
  const std::string whole = pc2_bytes(4, 175, 175);
  const ToolError error = refusal(whole.substr(0, 32 + 17 * 48 + 5));
  EXPECT_EQ(error.status(), ExitStatus::kInvalidInput);
  EXPECT_THAT(
      error.what(),
      HasSubstr("t.pc2 ends at byte 853 inside frame 17; its header promises 175 frames = 8432 bytes"));
  EXPECT_THAT(refusal(whole.substr(0, 20)).what(),
              HasSubstr("ends at byte 20 inside its header of 32 bytes"));
  EXPECT_THAT(open(whole + "abc").notes, Contains(HasSubstr("3 bytes follow byte 8432")));
  const std::string mdd = mdd_bytes(4, 9, 9, 1);
  EXPECT_THAT(refusal(mdd.substr(0, 20), "t.mdd").what(),
              HasSubstr("ends at byte 20 inside its table of times"));
  EXPECT_THAT(refusal(mdd.substr(0, 50), "t.mdd").what(), HasSubstr("ends at byte 50 inside frame 0"));
}

TEST_F(CacheSource, RefusesHeadersThatCannotBe) {
  EXPECT_THAT(refusal(pc2_bytes(5, 1, 1)).what(), HasSubstr("5 points per frame and 1 frames, but"));
  EXPECT_THAT(refusal(pc2_bytes(5, 1, 1)).what(), HasSubstr("t.obj has 4 vertices"));
  EXPECT_THAT(refusal(pc2_bytes(-4, 1, 1)).what(), HasSubstr("-4 points"));
  EXPECT_THAT(refusal(pc2_bytes(4, -1, 0)).what(), HasSubstr("-1 frames"));
  EXPECT_THAT(refusal(pc2_bytes(4, 0, 0)).what(), HasSubstr("holds no frames"));
  EXPECT_THAT(refusal(pc2_bytes(4, std::numeric_limits<std::int32_t>::max(), 1)).what(),
              HasSubstr("promises 2147483647 frames = 103079215088 bytes"));
  EXPECT_THAT(refusal(mdd_bytes(4, 0, 0, 1), "t.mdd").what(), HasSubstr("holds no frames"));
  std::string version_two = pc2_bytes(4, 1, 1);
  version_two[12] = 2;
  EXPECT_THAT(refusal(version_two).what(), HasSubstr("PC2 version 2, but only version 1"));
  EXPECT_THAT(refusal("\x89PNG\r\n\x1a\n and more").what(), HasSubstr("is a PNG image, not a cache"));
  EXPECT_THAT(refusal("something else, and long enough to be a header").what(),
              HasSubstr("begins with POINTCACHE2"));
}

TEST_F(CacheSource, RefusesNanAndInfinityWithFrameAndVertex) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    ByteString number(false);
    number.add(bad);
    std::string bytes = pc2_bytes(4, 3, 3);
    bytes.replace(32 + 2 * 48 + 12 + 8, 4, number.bytes());
    const Frames result = read_all(*open(bytes).source);
    EXPECT_EQ(result.frames.size(), 2U);
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->code, ErrorCode::kInvalidInput);
    EXPECT_THAT(result.error->message,
                HasSubstr("t.pc2: frame 2, vertex 1 has a coordinate that is NaN or infinite"));
  }
}

TEST_F(CacheSource, ReportsAFileThatShrinksWhileItIsRead) {
  const OpenedSource opened = open(pc2_bytes(4, 3, 3));
  std::filesystem::resize_file(folder_.path("t.pc2"), 32 + 48 + 7);
  const Frames result = read_all(*opened.source);
  EXPECT_EQ(result.frames.size(), 1U);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->code, ErrorCode::kTruncated);
  EXPECT_THAT(result.error->message,
              HasSubstr("ends at byte 87 inside frame 1; its header promises 3 frames"));
}

TEST_F(CacheSource, RangesSkipFramesAndRewindToTheirStart) {
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"t.pc2", pc2_bytes(4, 9, 9)},
                                    {"t.mdd", mdd_bytes(4, 9, 9, 0.1)}}) {
    const OpenedSource opened = open(bytes, name, FrameRange{3, 5});
    EXPECT_EQ(opened.source->frame_count(), 3U);
    for (int pass = 0; pass < 2; ++pass) {
      const Frames result = read_all(*opened.source);
      ASSERT_EQ(result.frames.size(), 3U);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(result.frames[i], tetrahedron_positions(3 + i));
      EXPECT_TRUE(opened.source->rewind());
    }
  }
  const ToolError outside = thrown_by([&] { open(pc2_bytes(4, 9, 9), "t.pc2", FrameRange{3, 9}); });
  EXPECT_EQ(outside.status(), ExitStatus::kUsage);
  EXPECT_THAT(outside.what(), HasSubstr("frames 3-9 are asked for, but"));
  EXPECT_THAT(outside.what(), HasSubstr("has the frames 0-8"));
  EXPECT_THAT(thrown_by([&] {
                open(pc2_bytes(4, 9, 9), "t.pc2", FrameRange{5, 3});
              }).what(),
              HasSubstr("the first comes after the last"));
}

TEST_F(CacheSource, ReadsBothFormatsFromAPipeWhichCannotBeRewound) {
  for (const std::string& bytes : {pc2_bytes(4, 5, 5), mdd_bytes(4, 5, 5, 0.1)}) {
    const StandardInput input(bytes);
    const OpenedSource opened = open_source({{"-", mesh_}, FrameRange{2, 4}});
    const Frames result = read_all(*opened.source);
    ASSERT_EQ(result.frames.size(), 3U);
    EXPECT_EQ(result.frames[0], tetrahedron_positions(2));
    EXPECT_FALSE(opened.source->rewind());
  }
}

TEST_F(CacheSource, ChecksTheCountsOfAPipeAsItIsRead) {
  {
    const StandardInput input(pc2_bytes(4, 5, 3) + "abc");
    const Frames result = read_all(*open_source({{"-", mesh_}, {}}).source);
    EXPECT_EQ(result.frames.size(), 3U);
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->code, ErrorCode::kTruncated);
    EXPECT_THAT(result.error->message, HasSubstr("standard input ends at byte 179 inside frame 3"));
  }
  {
    const StandardInput input(pc2_bytes(4, 2, 3));
    const Frames result = read_all(*open_source({{"-", mesh_}, {}}).source);
    EXPECT_EQ(result.frames.size(), 2U);
    ASSERT_TRUE(result.error);
    EXPECT_THAT(result.error->message, HasSubstr("standard input: bytes follow byte 128"));
  }
  {
    const StandardInput input("v 0 0 0\nv 1 0 0\n");
    EXPECT_THAT(thrown_by([&] {
                  open_source({{"-", mesh_}, {}});
                }).what(),
                HasSubstr("t.obj has 4 vertices"));
  }
}

TEST_F(CacheSource, HoldsOneFrameOfALongCacheInMemory) {
  // A sparse file of 4 GiB: reading it whole would show in the time and in the memory.
  const std::int32_t frames = 90'000'000;
  const std::string path = folder_.write("t.pc2", pc2_bytes(4, frames, 1));
  std::error_code refused;
  std::filesystem::resize_file(path, 32 + 48 * std::uint64_t{90'000'000}, refused);
  if (refused) GTEST_SKIP() << "this file system has no room for sparse files";
  const OpenedSource opened = open_source({{mesh_, path}, FrameRange{89'999'998, 89'999'999}});
  EXPECT_EQ(read_all(*opened.source).frames,
            (std::vector<FramePositions>{FramePositions(12), FramePositions(12)}));
}

}  // namespace
}  // namespace tvg::cli
