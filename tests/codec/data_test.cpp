#include "tests/codec/codec_toolbox.hpp"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <tvg/data.hpp>
#include <tvg/join.hpp>
#include <tvg/survey.hpp>

namespace tvg::test {
namespace {

std::vector<std::uint8_t> bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

Sequence some_sequence() {
  std::mt19937 random(3);
  return random_sequence(grid(4, 3), 5, random);
}

Stream with_data(std::vector<NamedData> data) {
  EncodeOptions options;
  options.data = std::move(data);
  options.metadata = {{"fps", "24"}};
  return encode_sequence(some_sequence(), options);
}

const std::vector<NamedData> kSome = {
    {"materials", bytes_of(std::string(300, 'm'))}, {"image/leaf.png", {1, 2, 3}}, {"empty", {}}};

class SourceWithData final : public SourceDecorator {
 public:
  SourceWithData(std::unique_ptr<FrameSource> source, std::vector<NamedData> data)
      : SourceDecorator(std::move(source)), data_(std::move(data)) {}
  std::span<const NamedData> data() const override { return data_; }

 private:
  std::vector<NamedData> data_;
};

TEST(NamedDataOfStreams, ComeBackInTheirOrder) {
  const DecodedStream decoded = decode_stream(with_data(kSome));
  ASSERT_TRUE(decoded.complete) << decoded.error.describe();
  EXPECT_EQ(decoded.data, kSome);
  EXPECT_EQ(decoded.frames.size(), 5u);
  EXPECT_TRUE(decoded.damage.empty());
}

TEST(NamedDataOfStreams, ComeBackFromAStreamInPiecesOfOneByte) {
  const DecodedStream decoded = decode_pieces(with_data(kSome), [] { return std::size_t{1}; });
  EXPECT_EQ(decoded.data, kSome);
}

TEST(NamedDataOfStreams, OfASourceFollowThoseOfTheOptionsUnlessTheyHaveTheSameName) {
  const Sequence sequence = some_sequence();
  SourceWithData source(std::make_unique<SequenceSource>(sequence), {{"a", {1}}, {"b", {2}}});
  EncodeOptions options;
  options.data = {{"b", {3}}};
  const Result<Stream> stream = try_encode(source, options);
  ASSERT_TRUE(stream) << stream.error().describe();
  EXPECT_EQ(decode_stream(*stream).data, (std::vector<NamedData>{{"b", {3}}, {"a", {1}}}));
}

TEST(NamedDataOfStreams, CostNothingWhereThereAreNone) {
  const Stream with = with_data({{"x", {1, 2}}}), without = with_data({});
  EXPECT_EQ(with.size(), without.size() + 20 + 6);
  EXPECT_EQ(decode_stream(without).data, std::vector<NamedData>());
}

TEST(NamedDataOfStreams, AreRefusedThatNoStreamCanHold) {
  const Sequence sequence = some_sequence();
  for (const std::vector<NamedData>& data :
       std::vector<std::vector<NamedData>>{{{"", {1}}},
                                           {{"\xFF", {1}}},
                                           {{std::string(kMaxDataNameBytes + 1, 'n'), {1}}},
                                           {{"a", {1}}, {"a", {2}}},
                                           {{"large", std::vector<std::uint8_t>(kMaxDataBytes + 1)}}}) {
    SequenceSource source(sequence);
    EncodeOptions options;
    options.data = data;
    const Result<Stream> stream = try_encode(source, options);
    ASSERT_FALSE(stream);
    EXPECT_EQ(stream.error().code, ErrorCode::kInvalidArgument);
  }
}

TEST(NamedDataOfStreams, LoseNoFrameWhereTheyAreDamaged) {
  const Stream good = with_data(kSome);
  const std::string name = "materials";
  const auto place = std::search(good.begin(), good.end(), name.begin(), name.end());
  ASSERT_NE(place, good.end());
  Stream damaged = good;
  damaged[static_cast<std::size_t>(place - good.begin())] ^= 1;
  const DecodedStream decoded = decode_stream(damaged);
  EXPECT_EQ(decoded.frames.size(), 5u);
  EXPECT_EQ(decoded.data, (std::vector<NamedData>{kSome[1], kSome[2]}));
}

TEST(NamedDataOfStreams, AreSurveyedByNameAndSize) {
  const Stream stream = with_data(kSome);
  const auto read = [&stream](std::uint64_t offset, std::span<std::uint8_t> bytes) {
    const std::size_t begin = std::min(stream.size(), static_cast<std::size_t>(offset));
    const std::size_t size = std::min(bytes.size(), stream.size() - begin);
    std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(begin), size, bytes.begin());
    return Result<std::size_t>(size);
  };
  const Result<StreamSurvey> seen = survey(read, stream.size());
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->data.size(), 3u);
  EXPECT_EQ(seen->data[0].name, "materials");
  EXPECT_EQ(seen->data[0].encoding, DataEncoding::kZstd);
  EXPECT_EQ(seen->data[0].decoded_size, 300u);
  EXPECT_EQ(seen->data[1].encoding, DataEncoding::kStored);
  EXPECT_EQ(seen->data[1].bytes, 20u + 1 + 14 + 1 + 1 + 3);
}

struct Joined {
  Stream stream;
  std::vector<std::string> notes;
};

Joined join_all(const std::vector<Stream>& streams) {
  std::vector<JoinInput> inputs;
  for (const Stream& stream : streams) {
    inputs.push_back({"input" + std::to_string(inputs.size()),
                      [&stream, at = std::size_t{0}](std::span<std::uint8_t> bytes) mutable {
                        const std::size_t size = std::min(bytes.size(), stream.size() - at);
                        std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(at), size, bytes.begin());
                        at += size;
                        return Result<std::size_t>(size);
                      }});
  }
  Joined joined;
  const Result<JoinReport> report =
      join(std::move(inputs), {}, [&joined](std::span<const std::uint8_t> bytes) {
        joined.stream.insert(joined.stream.end(), bytes.begin(), bytes.end());
        return Status();
      });
  EXPECT_TRUE(report) << report.error().describe();
  if (report) joined.notes = report->notes;
  return joined;
}

TEST(NamedDataOfStreams, OfJoinedStreamsAreKeptTheFirstOfEachName) {
  const Joined same = join_all({with_data(kSome), with_data(kSome)});
  EXPECT_EQ(decode_stream(same.stream).data, kSome);
  EXPECT_EQ(decode_stream(same.stream).frames.size(), 10u);
  EXPECT_TRUE(same.notes.empty()) << same.notes.front();

  const Joined other =
      join_all({with_data(kSome), with_data({{"other", {1}}, kSome[1], {kSome[0].name, {2}}})});
  std::vector<NamedData> all = kSome;
  all.push_back({"other", {1}});
  EXPECT_EQ(decode_stream(other.stream).data, all);
  ASSERT_EQ(other.notes.size(), 1u);
  EXPECT_EQ(other.notes[0],
            "input1: its data \"materials\" are left out; those of an earlier input are kept");
}

TEST(NamedDataOfStreams, OfFramesAreKeptOfOneWholeStreamAlone) {
  const std::vector<NamedData> times = {{"times", std::vector<std::uint8_t>(40)}};
  EXPECT_EQ(decode_stream(join_all({with_data(times)}).stream).data, times);
  const Joined two = join_all({with_data(times), with_data({})});
  EXPECT_TRUE(decode_stream(two.stream).data.empty());
  ASSERT_EQ(two.notes.size(), 1u);
  EXPECT_EQ(two.notes[0], "input0: data \"times\" are left out: they belong to all frames of one input");
}

}  // namespace
}  // namespace tvg::test
