#include "measure_toolbox.hpp"

#include <gtest/gtest.h>

namespace tvg::test {
namespace {

/// A patch that moves ever faster.
Sequence moving_patch(std::uint32_t frames) {
  Sequence sequence = patch(5, 5, false, [](std::uint32_t r, std::uint32_t c) {
    return std::array<double, 3>{double{1} * c, double{1} * r, 0};
  });
  for (std::uint32_t f = 1; f < frames; ++f) {
    FramePositions frame = sequence.frames[0];
    for (std::size_t v = 0; v < 25; ++v) frame[3 * v + 2] = static_cast<float>(f * ((v * 7 + f) % 11)) / 10;
    sequence.frames.push_back(frame);
  }
  return sequence;
}

Importance by_velocity() {
  Importance importance;
  importance.criteria = {{"velocity", 1}};
  return importance;
}

TEST(MeasureGops, IsTheMeasureOfEachRunOfFrames) {
  const Sequence sequence = moving_patch(11);
  SequenceSource source(sequence);
  std::vector<std::uint64_t> firsts;
  const Status status = measure_gops(source, 4, by_velocity(), [&](const GopMeasure& gop) {
    firsts.push_back(gop.first_frame);
    const std::span<const FramePositions> frames(sequence.frames.data() + gop.first_frame, gop.frames.size());
    EXPECT_TRUE(std::equal(frames.begin(), frames.end(), gop.frames.begin(), gop.frames.end()));
    EXPECT_EQ(gop.measured_frames, frames.size());
    const Result<Measure> expected = measure(sequence.mesh, frames, {}, {}, by_velocity());
    EXPECT_EQ(gop.measure.cost, expected->cost);
    EXPECT_EQ(gop.measure.flags, expected->flags);
    return Status();
  });
  EXPECT_TRUE(status.ok());
  EXPECT_EQ(firsts, (std::vector<std::uint64_t>{0, 4, 8}));
}

TEST(MeasureGops, LooksAtTheGopBeforeWhereDelayIsLow) {
  const Sequence sequence = moving_patch(8);
  SequenceSource source(sequence);
  Importance importance = by_velocity();
  importance.low_delay = true;
  std::vector<std::vector<double>> costs;
  std::vector<std::uint64_t> measured;
  ASSERT_TRUE(measure_gops(source, 4, importance, [&](const GopMeasure& gop) {
                costs.push_back(gop.measure.cost);
                measured.push_back(gop.measured_frames);
                return Status();
              }).ok());
  EXPECT_EQ(measured, (std::vector<std::uint64_t>{1, 4}));
  EXPECT_EQ(costs[0], std::vector<double>(25, 0.0)) << "one frame does not move";
  const std::span<const FramePositions> first(sequence.frames.data(), 4);
  EXPECT_EQ(costs[1], measure(sequence.mesh, first, {}, {}, by_velocity())->cost);
}

TEST(MeasureGops, EndsWithTheErrorOfTheSinkOrTheSource) {
  const Sequence sequence = moving_patch(8);
  SequenceSource source(sequence);
  int calls = 0;
  const Status stopped = measure_gops(source, 2, by_velocity(), [&](const GopMeasure&) {
    ++calls;
    return Status(Error{ErrorCode::kIo, "enough", {}, {}, ""});
  });
  EXPECT_EQ(stopped.error().message, "enough");
  EXPECT_EQ(calls, 1);

  Sequence bad = moving_patch(3);
  bad.frames[2][4] = NAN;
  SequenceSource bad_source(bad);
  const auto ignore = [](const GopMeasure&) { return Status(); };
  const Status refused = measure_gops(bad_source, 50, by_velocity(), ignore);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(refused.error().frame, 2u);
  const Sequence empty{sequence.mesh, {}, {}};
  SequenceSource empty_source(empty);
  EXPECT_EQ(measure_gops(empty_source, 50, by_velocity(), ignore).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(measure_gops(source, 0, by_velocity(), ignore).error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace tvg::test
