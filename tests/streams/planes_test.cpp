#include "tests/codec/codec_toolbox.hpp"
#include "tests/conformance/streams.hpp"
#include "tests/container/plan_streams.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <string>

#include <tvg/decoder.hpp>
#include <tvg/join.hpp>
#include <tvg/relay.hpp>
#include <tvg/survey.hpp>

// Streams with planes that several GOPs share, on their way from hand to hand.
namespace tvg::test {
namespace {

using ::testing::ElementsAre;

const Stream kMesh = some_mesh(1), kOtherMesh = some_mesh(2);
const Stream kPlan = some_plan(kMesh, 1), kSecondPlan = some_plan(kMesh, 2),
             kOtherPlan = some_plan(kOtherMesh, 3);

/// Four GOPs of two frames, the last of another mesh.
Stream some_stream() {
  return PlanStream(1, 2)
      .mesh(kMesh)
      .plan(kPlan)
      .gop(kMesh, {kPlan})
      .plan(kSecondPlan)
      .gop(kMesh, {kSecondPlan})
      .gop(kMesh, {kPlan})
      .mesh(kOtherMesh)
      .plan(kOtherPlan)
      .gop(kOtherMesh, {kOtherPlan})
      .end();
}

/// The types of all chunks, by their first letters.
std::string letters(const Stream& stream) {
  std::string result;
  for (std::size_t at = kSignature.size(); at < stream.size();) {
    const std::optional<ChunkHeader> header = read_chunk_header(Bytes(stream).subspan(at));
    if (!header) return result + "?";
    result += header->type[0];
    at += static_cast<std::size_t>(header->total_size());
  }
  return result;
}

Stream joined(std::vector<Stream> streams, std::optional<FrameRange> frames = {}) {
  std::vector<JoinInput> inputs;
  for (Stream& stream : streams) {
    inputs.push_back({"it", [&stream](std::span<std::uint8_t> bytes) -> Result<std::size_t> {
                        const std::size_t count = std::min(bytes.size(), stream.size());
                        std::copy_n(stream.begin(), count, bytes.begin());
                        stream.erase(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(count));
                        return count;
                      }});
  }
  JoinOptions options;
  options.frames = frames;
  Stream result;
  const Result<JoinReport> report = join(std::move(inputs), options, [&result](Bytes bytes) {
    result.insert(result.end(), bytes.begin(), bytes.end());
    return Status();
  });
  EXPECT_TRUE(report) << report.error().describe();
  return result;
}

TEST(PlanesOfStreams, JoinCopiesThoseThatGopsNeedOnceWhileTheyAreInForce) {
  const Stream stream = some_stream();
  EXPECT_EQ(letters(stream), "HMPGPGGMPGIT");
  EXPECT_EQ(joined({stream}), stream);
  EXPECT_EQ(letters(joined({stream, stream})), "HMPGPGGMPGMPGPGGMPGIT");
  EXPECT_EQ(letters(joined({stream}, FrameRange{2, 5})), "HMPGPGIT") << "each where it is needed";
  EXPECT_EQ(letters(joined({stream}, FrameRange{4, 5})), "HMPGIT");
  const Stream first = joined({stream}, FrameRange{0, 1}), third = joined({stream}, FrameRange{4, 5});
  EXPECT_EQ(letters(joined({first, third})), "HMPGGIT");
}

TEST(PlanesOfStreams, JoinKeepsThePartsOfABasisTogether) {
  const Stream stream = conformance::make_stream("lods_basis");
  EXPECT_EQ(letters(stream), "HMPPPGGPPPGGIT");
  EXPECT_EQ(joined({stream}), stream);
  const Stream second = joined({stream}, FrameRange{6, 9});
  EXPECT_EQ(letters(second), "HMPPPGGIT");
  const Stream thrice = joined({second, stream, second});
  EXPECT_EQ(letters(thrice), "HMPPPGGPPPGGPPPGGGGIT");
  for (const std::uint32_t lod : {0u, 1u, 2u}) {
    Decoder decoder;
    decoder.use_lod(lod);
    decoder.push(thrice);
    decoder.finish();
    DecodedStream decoded;
    drain(decoder, decoded);
    EXPECT_TRUE(decoded.complete && decoded.damage.empty());
    EXPECT_EQ(decoded.frames.size(), 18u);
  }
}

TEST(PlanesOfStreams, JoinedLimitsHoldForAllInputs) {
  const Stream small = PlanStream(1, 1).mesh(kMesh).plan(kPlan).gop(kMesh, {kPlan}).end();
  const Stream both = joined({small, some_stream()});
  Decoder decoder;
  decoder.push(both);
  while (decoder.poll() != Decoder::Event::kHead) {
  }
  EXPECT_EQ(decoder.head().limits, limits_with_plans(1, 2));
}

std::vector<StreamPart> parts_of(const Stream& stream) {
  StreamSplitter splitter;
  EXPECT_TRUE(splitter.push(stream).ok());
  std::vector<StreamPart> parts;
  for (;;) {
    Result<std::optional<StreamPart>> part = splitter.next();
    EXPECT_TRUE(part) << part.error().describe();
    if (!part || !*part) return parts;
    parts.push_back(std::move(**part));
  }
}

TEST(PlanesOfStreams, TheRelayPassesThemOnWithTheirNames) {
  const Stream stream = some_stream();
  const std::vector<StreamPart> parts = parts_of(stream);
  ASSERT_EQ(parts.size(), 11u);
  EXPECT_EQ(parts[2].kind, StreamPart::Kind::kPlan);
  EXPECT_EQ(parts[2].mesh, chunk_id(kMesh));
  EXPECT_EQ(parts[2].chunk, kPlan);
  EXPECT_THAT(parts[2].planes, ElementsAre(chunk_id(kPlan)));
  EXPECT_EQ(parts[6].kind, StreamPart::Kind::kGop);
  EXPECT_THAT(parts[6].planes, ElementsAre(chunk_id(kPlan)));
  Stream again;
  StreamAssembler assembler([&again](Bytes bytes) {
    again.insert(again.end(), bytes.begin(), bytes.end());
    return Status();
  });
  ASSERT_TRUE(assembler.begin(parts[0].limits, {}).ok());
  for (const StreamPart& part : parts) {
    if (part.kind == StreamPart::Kind::kMesh) {
      EXPECT_TRUE(assembler.write_mesh(part.chunk).ok());
    }
    if (part.kind == StreamPart::Kind::kPlan) {
      EXPECT_TRUE(assembler.write_plan(part.chunk).ok());
    }
    if (part.kind == StreamPart::Kind::kGop) {
      EXPECT_TRUE(assembler.write_gop(part.chunk, part.frame_count).ok());
    }
  }
  EXPECT_TRUE(assembler.end().ok());
  EXPECT_EQ(again, stream);
}

TEST(PlanesOfStreams, ASurveyListsTheirChunks) {
  const Stream stream = some_stream();
  const Result<StreamSurvey> result =
      survey([&stream](std::uint64_t offset, std::span<std::uint8_t> bytes) -> Result<std::size_t> {
        const std::size_t at = std::min(static_cast<std::size_t>(offset), stream.size());
        const std::size_t count = std::min(bytes.size(), stream.size() - at);
        std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(at), count, bytes.begin());
        return count;
      });
  ASSERT_TRUE(result);
  EXPECT_EQ(result->bytes, stream.size());
  EXPECT_EQ(std::ranges::count(result->chunks, "PLAN", &ChunkInfo::type), 3);
}

}  // namespace
}  // namespace tvg::test
