#include "tests/codec/codec_toolbox.hpp"

#include <algorithm>
#include <bit>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include <tvg/join.hpp>
#include <tvg/parts.hpp>

// Parts of a sequence that are encoded apart and joined have the bytes of the sequence that is encoded whole.
namespace tvg::test {
namespace {

using ::testing::HasSubstr;

/// A strip of triangles; each count is another mesh.
Mesh strip(std::uint32_t triangles) {
  Mesh mesh{triangles + 2, {}};
  for (std::uint32_t i = 0; i < triangles; ++i) mesh.faces.push_back({i, i + 1, i + 2});
  return mesh;
}

/// Frames of strips that come and go.
class StripSource final : public FrameSource {
 public:
  struct Stretch {
    std::uint32_t triangles;
    std::size_t frames;
  };

  explicit StripSource(std::vector<Stretch> stretches, unsigned seed = 1) : stretches_(std::move(stretches)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> little(-0.01F, 0.01F);
    for (const Stretch& stretch : stretches_) {
      for (std::size_t f = 0; f < stretch.frames; ++f) {
        FramePositions& frame = frames_.emplace_back();
        for (std::uint32_t v = 0; v < stretch.triangles + 2; ++v) {
          for (const float x : {0.1F * static_cast<float>(v), static_cast<float>(v % 2), 0.0F})
            frame.push_back(x + little(random));
        }
      }
    }
    rewind();
  }

  const Mesh& mesh() const override { return mesh_; }
  std::optional<std::uint64_t> frame_count() const override { return frames_.size(); }
  std::span<const NamedData> data() const override { return data_; }
  bool mesh_may_change() const override { return stretches_.size() > 1; }
  bool rewind() override {
    next_ = stretch_ = left_ = 0;
    mesh_ = strip(stretches_[0].triangles);
    left_ = stretches_[0].frames;
    return can_rewind_;
  }
  Result<bool> read_frame(std::span<float> positions) override {
    if (next_ == frames_.size()) return false;
    if (left_ == 0) return Error{ErrorCode::kInvalidInput, "another mesh"};
    std::copy(frames_[next_].begin(), frames_[next_].end(), positions.begin());
    ++next_;
    --left_;
    return true;
  }
  Result<bool> begin_next_mesh() override {
    if (left_ > 0 || stretch_ + 1 == stretches_.size()) return false;
    ++stretch_;
    mesh_ = strip(stretches_[stretch_].triangles);
    left_ = stretches_[stretch_].frames;
    return true;
  }

  void add_data(NamedData data) { data_.push_back(std::move(data)); }
  void read_once_only() { can_rewind_ = false; }
  std::vector<FramePositions>& frames() { return frames_; }

 private:
  std::vector<Stretch> stretches_;
  std::vector<FramePositions> frames_;
  std::vector<NamedData> data_;
  Mesh mesh_;
  std::size_t next_ = 0, stretch_ = 0, left_ = 0;
  bool can_rewind_ = true;
};

ByteSink into(Stream& stream) {
  return [&stream](std::span<const std::uint8_t> bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  };
}

JoinInput from(const Stream& stream, std::string name) {
  return {std::move(name), [&stream, at = std::size_t{0}](std::span<std::uint8_t> bytes) mutable {
            const std::size_t count = std::min(bytes.size(), stream.size() - at);
            std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(at), count, bytes.begin());
            at += count;
            return Result<std::size_t>(count);
          }};
}

Result<Stream> joined(const std::vector<Stream>& parts) {
  std::vector<JoinInput> inputs;
  for (const Stream& part : parts)
    inputs.push_back(from(part, "stream " + std::to_string(inputs.size() + 1)));
  Stream whole;
  const Result<JoinReport> report = join(std::move(inputs), {}, into(whole));
  if (!report) return report.error();
  EXPECT_THAT(report->notes, ::testing::IsEmpty());
  return whole;
}

/// Each part by itself, with marks.
std::vector<Stream> encode_parts(FrameSource& source, const EncodeOptions& options, std::uint32_t parts) {
  const Result<EncodePlan> plan = plan_encoding(source, options);
  EXPECT_TRUE(plan) << plan.error().message;
  std::vector<Stream> streams;
  if (!plan) return streams;
  const std::vector<FrameRange> ranges = cut_into_parts(*plan, parts);
  for (std::size_t i = ranges.size(); i-- > 0;) {  // in whatever order
    EXPECT_TRUE(source.rewind());
    EncodeOptions of_part = options;
    of_part.threads = 1 + static_cast<unsigned>(i % 3);
    of_part.data.push_back(
        part_data({"abc123", static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>(ranges.size())}));
    Stream stream;
    const Result<EncodeReport> report = encode_part(source, of_part, *plan, ranges[i], into(stream));
    EXPECT_TRUE(report) << report.error().message;
    if (report) {
      EXPECT_EQ(report->frames, ranges[i].last - ranges[i].first + 1);
    }
    streams.insert(streams.begin(), std::move(stream));
  }
  return streams;
}

void expect_same_as_whole(StripSource& source, const EncodeOptions& options, const std::string& what) {
  EXPECT_TRUE(source.rewind());
  const Result<Stream> whole = try_encode(source, options);
  ASSERT_TRUE(whole) << what << ": " << whole.error().message;
  for (const std::uint32_t parts : {1u, 2u, 3u, 7u, 100u}) {
    const Result<Stream> again = joined(encode_parts(source, options, parts));
    ASSERT_TRUE(again) << what << ", " << parts << " parts: " << again.error().message;
    EXPECT_TRUE(*again == *whole) << what << ", " << parts << " parts";
  }
}

std::vector<std::pair<std::string, EncodeOptions>> all_kinds() {
  std::vector<std::pair<std::string, EncodeOptions>> kinds;
  const auto add = [&](const char* name) -> EncodeOptions& {
    kinds.emplace_back(name, EncodeOptions());
    kinds.back().second.gop_frames = 3;
    return kinds.back().second;
  };
  add("elp");
  add("step").step = 0.01;
  add("pyramid").predictor = Predictor::kPyramid;
  add("auto").predictor = Predictor::kAuto;
  add("lossless").mode = Mode::kLossless;
  EncodeOptions& basis = add("basis");
  basis.mode = Mode::kBasis;
  basis.period_frames = 5;
  EncodeOptions& bounded = add("largest error");
  bounded.mode = Mode::kBasis;
  bounded.max_error = ErrorBound{0.001, true};
  EncodeOptions& marked = add("two resolutions");
  marked.fine_bits = 13;
  EncodeOptions& low_delay = add("marked by the GOP before");
  low_delay.fine_bits = 13;
  low_delay.importance.low_delay = true;
  low_delay.predictor = Predictor::kPyramid;
  return kinds;
}

TEST(EncodeParts, OfOneMeshJoinToTheBytesOfTheWhole) {
  StripSource source({{30, 23}});
  for (const auto& [name, options] : all_kinds()) expect_same_as_whole(source, options, name);
}

TEST(EncodeParts, OfMeshesThatComeAndGoJoinToTheBytesOfTheWhole) {
  StripSource source({{5, 4}, {9, 3}, {5, 7}, {7, 2}, {9, 5}, {11, 1}, {5, 4}, {7, 6}, {9, 2}, {5, 3}});
  for (const auto& [name, options] : all_kinds()) {
    for (const std::uint32_t kept : {1u, 2u, 3u}) {
      EncodeOptions keeping = options;
      keeping.max_meshes = kept;
      expect_same_as_whole(source, keeping, name + ", " + std::to_string(kept) + " kept");
    }
  }
}

TEST(EncodeParts, OfCapturedVolumesJoinToTheBytesOfTheWhole) {
  StripSource source({{300, 1}, {301, 1}, {310, 1}, {280, 1}, {305, 1}});
  for (const auto& [name, options] : all_kinds()) {
    EncodeOptions suited = options;
    suited.suit_captured = true;
    expect_same_as_whole(source, suited, name);
  }
}

TEST(EncodeParts, HaveTheTimesAndJointsOfTheirOwnFramesWhichJoinAgain) {
  StripSource source({{6, 10}});
  NamedData times{"times", {}}, joints{"skeleton/positions", {}};
  for (std::uint64_t frame = 0; frame < 10; ++frame) {
    const auto bits = std::bit_cast<std::uint64_t>(0.5 + static_cast<double>(frame * frame));
    for (int byte = 0; byte < 8; ++byte) times.bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * byte)));
    joints.bytes.insert(joints.bytes.end(), 24, static_cast<std::uint8_t>(frame));
  }
  source.add_data({"materials", {'{', '}'}});
  source.add_data(times);
  source.add_data(joints);
  EncodeOptions options;
  options.gop_frames = 2;
  expect_same_as_whole(source, options, "data");
  const std::vector<Stream> parts = encode_parts(source, options, 5);
  ASSERT_EQ(parts.size(), 5U);
  const DecodedStream second = decode_stream(parts[1]);
  const auto found = std::find_if(second.data.begin(), second.data.end(),
                                  [](const NamedData& data) { return data.name == "skeleton/positions"; });
  ASSERT_NE(found, second.data.end());
  EXPECT_EQ(found->bytes.size(), 48U);
  EXPECT_EQ(found->bytes.front(), 2);
}

TEST(EncodeParts, ThatAreMissingOrOutOfOrderAreNamedByJoin) {
  StripSource source({{6, 12}});
  EncodeOptions options;
  options.gop_frames = 2;
  std::vector<Stream> parts = encode_parts(source, options, 4);
  ASSERT_EQ(parts.size(), 4U);
  const auto message = [](const std::vector<Stream>& streams) {
    const Result<Stream> result = joined(streams);
    return result ? std::string("joined") : result.error().message;
  };
  EXPECT_THAT(message({parts[0], parts[2], parts[3]}),
              HasSubstr("part 2 of 4 is missing: stream 2 is part 3"));
  EXPECT_THAT(message({parts[0], parts[1]}), HasSubstr("parts 3 to 4 of 4 are missing"));
  EXPECT_THAT(message({parts[1], parts[2], parts[3]}), HasSubstr("part 1 of 4 is missing"));
  EXPECT_THAT(message({parts[0], parts[1], parts[1], parts[2], parts[3]}), HasSubstr("where part 3 is due"));
  StripSource single({{6, 2}});
  const Result<Stream> other = try_encode(single, options);
  ASSERT_TRUE(other);
  EXPECT_THAT(message({parts[0], *other, parts[1]}), HasSubstr("stream 2 is no part of that whole"));
  EXPECT_EQ(message({*other, parts[0], parts[1], parts[2], parts[3], *other}), "joined");
  parts[1].resize(parts[1].size() - 1);
  EXPECT_THAT(message(parts), HasSubstr("stream 2"));
}

TEST(EncodeParts, AreKnownByTheirMarksAndOnlyWhenWhole) {
  StripSource source({{6, 6}});
  EncodeOptions options;
  options.gop_frames = 2;
  Stream part = encode_parts(source, options, 3).at(1);
  const Result<std::optional<PartMark>> mark = check_part(from(part, "part"));
  ASSERT_TRUE(mark);
  EXPECT_EQ(*mark, (PartMark{"abc123", 2, 3}));
  part[part.size() / 2] ^= 1;
  EXPECT_FALSE(check_part(from(part, "part")));
  for (const char* const text :
       {"", "abc", "abc 0 3", "abc 4 3", "abc 1 3 ", "a b 1", "-1 1 3", "abc 1 99999999999"})
    EXPECT_FALSE(part_mark({kPartData, {text, text + std::string(text).size()}})) << text;
}

TEST(EncodeParts, RefuseWhatIsNoPartOrNotWhatWasPlanned) {
  StripSource source({{6, 7}, {8, 5}});
  EncodeOptions options;
  options.gop_frames = 3;
  const Result<EncodePlan> plan = plan_encoding(source, options);
  ASSERT_TRUE(plan);
  const auto refusal = [&](FrameSource& from_source, const EncodePlan& by, FrameRange range) {
    Stream stream;
    const Result<EncodeReport> report = encode_part(from_source, options, by, range, into(stream));
    return report ? std::string("encoded") : report.error().message;
  };
  EXPECT_THAT(refusal(source, *plan, {2, 5}), HasSubstr("within what is encoded together"));
  EXPECT_THAT(refusal(source, *plan, {3, 7}), HasSubstr("within what is encoded together"));
  EXPECT_THAT(refusal(source, *plan, {9, 12}), HasSubstr("no part of the 12 frames"));
  StripSource longer({{6, 7}, {8, 6}});
  EXPECT_THAT(refusal(longer, *plan, {0, 2}), HasSubstr("has 13 frames; it had 12"));
  StripSource other({{7, 7}, {8, 5}});
  EXPECT_THAT(refusal(other, *plan, {0, 2}), HasSubstr("another one than when the input was planned"));
  EncodePlan broken = *plan;
  broken.stretches[1].first_frame = 8;
  EXPECT_THAT(refusal(source, broken, {0, 2}), HasSubstr("contradicts itself"));
  broken = *plan;
  broken.stretches[1].shaped_by = 9;
  EXPECT_THAT(refusal(source, broken, {0, 2}), HasSubstr("contradicts itself"));
  StripSource far({{6, 7}, {8, 5}});
  far.frames()[1][0] = 1e6F;
  EXPECT_THAT(refusal(far, *plan, {0, 2}), HasSubstr("leaves the box"));
  StripSource once({{6, 7}, {8, 5}});
  once.read_once_only();
  const Result<EncodePlan> none = plan_encoding(once, options);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("only once"));
}

TEST(EncodeParts, AreOfAboutAsManyVerticesAndNeverMoreThanAskedFor) {
  EncodePlan plan;
  plan.frames_at_once = 10;
  plan.frames = 1005;
  plan.stretches = {{0, 500, 100, 0, 0}, {500, 505, 300, 1, 500}};
  for (const std::uint32_t parts : {1u, 2u, 5u, 16u, 101u, 5000u}) {
    const std::vector<FrameRange> ranges = cut_into_parts(plan, parts);
    EXPECT_EQ(ranges.size(), std::min(parts, 101u));
    std::uint64_t next = 0;
    for (const FrameRange& range : ranges) {
      EXPECT_EQ(range.first, next);
      EXPECT_LE(range.first, range.last);
      next = range.last + 1;
      double vertices = 0;
      for (std::uint64_t frame = range.first; frame <= range.last; ++frame)
        vertices += frame < 500 ? 100 : 300;
      EXPECT_LE(vertices, (500 * 100 + 505 * 300) / static_cast<double>(ranges.size()) + 3000) << parts;
    }
    EXPECT_EQ(next, plan.frames);
  }
}

}  // namespace
}  // namespace tvg::test
