#include "codec_toolbox.hpp"
#include "corpus/corpus.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>

#include <tvg/measure.hpp>

// What the encoder makes of the measure, seen through the streams.
namespace tvg {
namespace {

using namespace tvg::test;

EncodeOptions hybrid(std::vector<CriterionWeight> criteria, std::uint32_t gop_frames = 4) {
  EncodeOptions options;
  options.fine_bits = 12;
  options.coarse_bits = 10;
  options.gop_frames = gop_frames;
  options.importance.criteria = std::move(criteria);
  return options;
}

Stream encode_hand(const corpus::SkinnedSequence& hand, const EncodeOptions& options) {
  SequenceSource source(hand.sequence, &hand.joints);
  const Result<Stream> stream = try_encode(source, options);
  EXPECT_TRUE(stream) << (stream ? "" : stream.error().describe());
  return stream ? *stream : Stream();
}

std::vector<std::uint8_t> measured(const corpus::SkinnedSequence& hand, std::size_t first, std::size_t count,
                                   const Importance& importance) {
  const auto part = [&](const auto& frames) {
    return std::vector<std::vector<float>>(frames.begin() + static_cast<std::ptrdiff_t>(first),
                                           frames.begin() + static_cast<std::ptrdiff_t>(first + count));
  };
  const Result<Measure> result = measure(hand.sequence.mesh, part(hand.sequence.frames), hand.joints.skeleton,
                                         part(hand.joints.frames), importance);
  EXPECT_TRUE(result);
  return result->flags;
}

TEST(MeasuredStream, CarriesTheFlagsOfTheMeasureOfEachGop) {
  const corpus::SkinnedSequence hand = corpus::make_hand({400, 10});
  for (const std::vector<CriterionWeight>& criteria : std::vector<std::vector<CriterionWeight>>{
           {{"skel", 1}}, {{"curv", 1}, {"skel", 0.01}}, {{"velocity", 1}}, {{"curvature-norm", -1}}}) {
    const EncodeOptions options = hybrid(criteria);
    const DecodedStream decoded = decode_stream(encode_hand(hand, options));
    ASSERT_EQ(decoded.frames.size(), 10U);
    for (const std::size_t first : {0U, 4U, 8U}) {
      const std::size_t count = std::min<std::size_t>(4, 10 - first);
      EXPECT_EQ(decoded.frames[first].flags, measured(hand, first, count, options.importance))
          << criteria[0].name << ", frame " << first;
    }
  }
}

TEST(MeasuredStream, WithoutDelayIsMarkedByTheGopBefore) {
  const corpus::SkinnedSequence hand = corpus::make_hand({400, 10});
  EncodeOptions options = hybrid({{"curv", 1}, {"skel", 0.01}});
  options.importance.low_delay = true;
  const DecodedStream decoded = decode_stream(encode_hand(hand, options));
  ASSERT_EQ(decoded.frames.size(), 10U);
  EXPECT_EQ(decoded.frames[0].flags, measured(hand, 0, 1, options.importance));
  EXPECT_EQ(decoded.frames[4].flags, measured(hand, 0, 4, options.importance));
  EXPECT_EQ(decoded.frames[8].flags, measured(hand, 4, 4, options.importance));
}

TEST(MeasuredStream, WithoutDelayHasFlagsThatLaterFramesCannotChange) {
  corpus::SkinnedSequence hand = corpus::make_hand({400, 12});
  EncodeOptions options = hybrid({{"velocity", 1}, {"skel", 0.001}});
  options.importance.low_delay = true;
  const DecodedStream before = decode_stream(encode_hand(hand, options));
  // All but the first frame of the last GOP become something else.
  std::mt19937 random(4);
  std::uniform_real_distribution<float> anywhere(-10, 10);
  for (std::size_t f = 9; f < 12; ++f) {
    for (float& x : hand.sequence.frames[f]) x = anywhere(random);
    for (float& x : hand.joints.frames[f]) x = anywhere(random);
  }
  const DecodedStream after = decode_stream(encode_hand(hand, options));
  for (std::size_t f = 0; f < 12; ++f) EXPECT_EQ(before.frames[f].flags, after.frames[f].flags) << f;
  options.importance.low_delay = false;
  const DecodedStream ahead = decode_stream(encode_hand(hand, options));
  EXPECT_NE(ahead.frames[8].flags, after.frames[8].flags) << "the measure must have something to see";
}

TEST(MeasuredStream, HasTheSameBytesWithAnyNumberOfThreads) {
  const corpus::SkinnedSequence hand = corpus::make_hand({1600, 18});
  for (const bool low_delay : {false, true}) {
    EncodeOptions options = hybrid(
        {{"curv", 1}, {"skel", 0.1}, {"velocity", -2}, {"curvature-norm", 0.01}, {"distance", 0.1}}, 3);
    options.importance.low_delay = low_delay;
    options.threads = 1;
    const Stream one = encode_hand(hand, options);
    for (const unsigned threads : {2U, 3U, 8U}) {
      options.threads = threads;
      EXPECT_EQ(encode_hand(hand, options), one) << threads << (low_delay ? ", low delay" : "");
    }
  }
}

TEST(MeasuredStream, DoesNotLookAtJointsUnlessACriterionDoes) {
  corpus::SkinnedSequence hand = corpus::make_hand({400, 4});
  const Stream with_joints = encode_hand(hand, hybrid({{"curv", 1}}));
  EXPECT_EQ(encode_sequence(hand.sequence, hybrid({{"curv", 1}})), with_joints);
  hand.joints.frames[2][5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(encode_hand(hand, hybrid({{"curv", 1}})), with_joints);
}

TEST(MeasuredStream, IsRefusedWithTheReasonWhereJointsAreMissing) {
  const corpus::SkinnedSequence hand = corpus::make_hand({400, 6});
  const auto failure = [&](const JointTracks* joints) {
    SequenceSource source(hand.sequence, joints);
    const Result<Stream> stream = try_encode(source, hybrid({{"skel", 1}}));
    return stream ? Error{} : stream.error();
  };
  EXPECT_EQ(failure(nullptr).code, ErrorCode::kInvalidArgument);
  JointTracks joints = hand.joints;
  joints.frames[5][7] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(failure(&joints).code, ErrorCode::kInvalidInput);
  EXPECT_EQ(failure(&joints).frame, 5U);
  joints = hand.joints;
  joints.frames.pop_back();
  EXPECT_THAT(failure(&joints).message, testing::HasSubstr("0 of the skeleton's 21 joints"));
}

TEST(MeasuredStream, FindsTheFingersOfTheHandDynamicAndNotTheirTips) {
  const corpus::SkinnedSequence hand = corpus::make_hand({400, 50});
  Importance importance;
  importance.criteria = {{"skel", 1}};
  const Result<Measure> result =
      measure(hand.sequence.mesh, hand.sequence.frames, hand.joints.skeleton, hand.joints.frames, importance);
  ASSERT_TRUE(result);
  std::size_t bending = 0;
  for (std::size_t j = 0; j < result->joints.size(); ++j) {
    const std::string& name = hand.joints.skeleton.joint_names[j];
    if (name.ends_with("tip")) {
      EXPECT_EQ(result->joints[j].angle_sum, 0) << name;
      EXPECT_FALSE(result->joints[j].dynamic) << name;
    } else if (result->joints[j].dynamic) {
      ++bending;
    }
  }
  EXPECT_GE(bending, 10U);
}

}  // namespace
}  // namespace tvg
