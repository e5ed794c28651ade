#include "tests/codec/codec_toolbox.hpp"
#include "tests/conformance/streams.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <tvg/survey.hpp>

namespace tvg::test {
namespace {

struct Surveyed {
  Result<StreamSurvey> result;
  std::size_t bytes_read = 0;
};

enum class Size { kKnown, kUnknown };

Surveyed survey_stream(const Stream& stream, Size size_is = Size::kKnown) {
  std::size_t count = 0;
  const auto read = [&](std::uint64_t offset, std::span<std::uint8_t> bytes) {
    if (size_is == Size::kUnknown) {
      EXPECT_EQ(offset, count) << "a pipe has no other bytes";
    }
    const std::size_t begin = std::min(stream.size(), static_cast<std::size_t>(offset));
    const std::size_t size = std::min(bytes.size(), stream.size() - begin);
    std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(begin), size, bytes.begin());
    count += size;
    return Result<std::size_t>(size);
  };
  Result<StreamSurvey> result =
      size_is == Size::kKnown ? survey(read, stream.size()) : survey(read, std::nullopt);
  return {std::move(result), count};
}

TEST(Survey, SaysWhatDecodingSays) {
  for (const conformance::ConformanceStream& entry : conformance::conformance_streams()) {
    SCOPED_TRACE(entry.name);
    const Stream stream = entry.make();
    const DecodedStream decoded = decode_stream(stream);
    const Surveyed surveyed = survey_stream(stream), piped = survey_stream(stream, Size::kUnknown);
    ASSERT_TRUE(surveyed.result && piped.result);
    const StreamSurvey& seen = *surveyed.result;
    EXPECT_EQ(piped.result->frames(), seen.frames());
    EXPECT_EQ(piped.result->bytes, seen.bytes);
    EXPECT_TRUE(seen.findings.empty());
    EXPECT_EQ(seen.bytes, stream.size());
    EXPECT_EQ(seen.head.limits, decoded.head.limits);
    EXPECT_EQ(seen.metadata, decoded.metadata);
    EXPECT_EQ(seen.frames(), decoded.frames.size());
    const auto is_mesh = [](const IndexEntry& place) { return place.kind == IndexEntry::Kind::kMesh; };
    EXPECT_EQ(static_cast<std::ptrdiff_t>(seen.meshes.size()),
              std::count_if(decoded.index.begin(), decoded.index.end(), is_mesh));
    for (std::size_t i = 0; i < seen.gops.size(); ++i) {
      const DecodedFrame& frame = decoded.frames[seen.gops[i].first_frame];
      EXPECT_EQ(seen.meshes[seen.gop_meshes[i]].vertices, frame.flags.size());
    }
    for (const GopInfo& gop : seen.gops) {
      const GopInfo& other = decoded.frames[gop.first_frame].gop;
      EXPECT_EQ(gop.source_frame, other.source_frame);
      EXPECT_EQ(gop.frame_count, other.frame_count);
      EXPECT_EQ(gop.step, other.step);
      EXPECT_EQ(gop.bytes, other.bytes);
      EXPECT_EQ(gop.header_bytes, other.header_bytes);
      EXPECT_EQ(gop.flag_bytes, other.flag_bytes);
    }
  }
}

TEST(Survey, TakesWhatAnotherWriterMakes) {
  for (const char* folder : {"random", "negative"}) {
    const auto path = std::filesystem::path(TVG_CONFORMANCE_FOLDER) / folder;
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      if (entry.path().extension() != ".tvg") continue;
      SCOPED_TRACE(entry.path().filename());
      std::ifstream file(entry.path(), std::ios::binary);
      const Stream stream{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
      const Surveyed surveyed = survey_stream(stream);
      if (std::string(folder) != "random") continue;
      ASSERT_TRUE(surveyed.result);
      EXPECT_TRUE(surveyed.result->findings.empty());
      EXPECT_EQ(surveyed.result->frames(), decode_stream(stream).frames.size());
    }
  }
}

TEST(Survey, ReadsLittleOfLongGops) {
  std::mt19937 random(1);
  EncodeOptions options;
  options.gop_frames = 200;
  const Stream stream = encode_sequence(random_sequence(grid(20, 20), 400, random), options);
  const Surveyed surveyed = survey_stream(stream);
  ASSERT_TRUE(surveyed.result);
  EXPECT_EQ(surveyed.result->frames(), 400u);
  EXPECT_LT(surveyed.bytes_read, stream.size() / 4);
}

TEST(Survey, FindsWhatIsOutOfPlaceAndRefusesWhatIsCut) {
  Stream stream = conformance::make_stream("gops");
  const Stream cut(stream.begin(), stream.end() - 1);
  EXPECT_FALSE(survey_stream(cut).result);
  stream[stream.size() - 60] ^= 1;  // in the index
  const Surveyed surveyed = survey_stream(stream);
  ASSERT_TRUE(surveyed.result);
  EXPECT_FALSE(surveyed.result->findings.empty());
}

TEST(Survey, NamesTheByteAtWhichACutStreamEnds) {
  std::mt19937 random(2);
  EncodeOptions options;
  options.gop_frames = 40;
  const Stream stream = encode_sequence(random_sequence(grid(20, 20), 80, random), options);
  for (std::size_t size = 1; size < stream.size(); size += 1 + size / 7) {
    const Stream cut(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(size));
    for (const Size size_is : {Size::kKnown, Size::kUnknown}) {
      const Surveyed surveyed = survey_stream(cut, size_is);
      ASSERT_FALSE(surveyed.result);
      EXPECT_EQ(surveyed.result.error().code, ErrorCode::kTruncated);
      EXPECT_EQ(surveyed.result.error().byte_offset, size);
    }
  }
}

}  // namespace
}  // namespace tvg::test
