#include "player/overlay/overlay_colours.hpp"

#include "corpus/corpus.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tvg::player {
namespace {

constexpr std::size_t kGop = 6;

class Colours : public ::testing::Test {
 protected:
  Colours() : hand_(corpus::find_corpus_entry("hand")->make({400, 2 * kGop}).sequence) {}

  std::vector<FramePositions> gop(std::size_t number) const {
    const auto first = hand_.frames.begin() + static_cast<std::ptrdiff_t>(number * kGop);
    return {first, first + kGop};
  }
  OverlayFrame frame(std::size_t number) const { return {number, hand_.mesh, hand_.frames[number], {}}; }
  std::vector<float> colour(OverlayColours& colours, std::size_t number) const {
    std::vector<float> values;
    colours.colour(frame(number), values);
    return values;
  }

  /// The sequence as it is, or pushed aside by `offset`, as a reference.
  std::shared_ptr<ReferenceFrames> reference(float offset, std::size_t frames) {
    pushed_ = hand_;
    pushed_.frames.resize(frames);
    for (FramePositions& positions : pushed_.frames) {
      for (std::size_t v = 0; v < positions.size(); v += 3) positions[v] += offset;
    }
    ShownFramesSpec spec;
    spec.inputs = {"pushed.obj"};
    spec.open_source = [this](const auto&, const auto&) { return std::make_unique<SequenceSource>(pushed_); };
    return std::make_shared<ReferenceFrames>(spec, "hand.tvg");
  }

  const Sequence hand_;
  Sequence pushed_;
};

TEST_F(Colours, CostIsTheSameWhetherAGopIsKnownAheadOrComesTwice) {
  const auto ahead = make_overlay_colours({Overlay::kCost, 0.2, nullptr});
  const auto by_and_by = make_overlay_colours({Overlay::kCost, 0.2, nullptr});
  for (std::size_t number = 0; number < 2; ++number) {
    const std::vector<FramePositions> frames = gop(number);
    ahead->begin_gop({number * kGop, kGop, {frames}});
    const std::vector<float> values = colour(*ahead, number * kGop);
    EXPECT_GT(*std::max_element(values.begin(), values.end()), 0);
    for (int round = 0; round < 2; ++round) {
      by_and_by->begin_gop({number * kGop, kGop, {}});
      for (std::size_t f = 0; f < kGop; ++f) {
        const bool known = round > 0 || f + 1 == kGop;
        EXPECT_EQ(colour(*by_and_by, number * kGop + f) == values, known) << number << " " << f;
      }
    }
  }
}

TEST_F(Colours, CostIsSeenFromTheMiddleOfAGopOn) {
  const auto colours = make_overlay_colours({Overlay::kCost, {}, nullptr});
  colours->begin_gop({0, kGop, {}});
  const std::vector<float> values = colour(*colours, 3);
  EXPECT_EQ(*std::max_element(values.begin(), values.end()), 1);
}

TEST_F(Colours, CostIsOfTheMeasureThatIsAskedFor) {
  const std::vector<FramePositions> frames = gop(0);
  const auto by = [&](const std::string& criterion, double weight) {
    OverlaySpec spec{Overlay::kCost, {}, nullptr};
    spec.measure.importance.criteria = {{criterion, weight}};
    spec.measure.words = criterion;
    auto colours = make_overlay_colours(spec);
    colours->begin_gop({0, kGop, {frames}});
    return colours;
  };
  const auto curv = by("curv", 1);
  const auto velocity = by("velocity", 1);
  EXPECT_NE(colour(*curv, 0), colour(*velocity, 0));
  EXPECT_EQ(velocity->legend().title, "cost (velocity)");
  const auto near = by("distance", -1);
  const std::vector<float> values = colour(*near, 0);
  const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
  EXPECT_EQ(*smallest, 0) << "negative costs have colours of their own";
  EXPECT_EQ(*largest, 1);
  EXPECT_LT(near->legend().smallest, near->legend().largest);
  EXPECT_LT(near->legend().largest, 0);
  EXPECT_THROW(colour(*by("skel", 1), 0), cli::ToolError) << "there is no skeleton";
}

TEST_F(Colours, CostFollowsTheJoints) {
  const corpus::SkinnedSequence animated = corpus::make_hand({400, 2 * kGop});
  OverlaySpec spec{Overlay::kCost, {}, nullptr};
  spec.measure.importance.criteria = {{"skel", 1}};
  const auto ahead = make_overlay_colours(spec);
  const auto by_and_by = make_overlay_colours(spec);
  const std::vector<FramePositions> frames = gop(1);
  const std::vector<std::vector<float>> joints(animated.joints.frames.begin() + kGop,
                                               animated.joints.frames.end());
  const Skeleton& skeleton = animated.joints.skeleton;
  ahead->begin_gop({kGop, kGop, {frames, &skeleton, joints}});
  by_and_by->begin_gop({kGop, kGop, {{}, &skeleton}});
  std::vector<float> last;
  for (std::size_t f = 0; f < kGop; ++f) {
    OverlayFrame shown = frame(kGop + f);
    shown.joints = joints[f];
    by_and_by->colour(shown, last);
  }
  const std::vector<float> whole = colour(*ahead, kGop);
  EXPECT_EQ(last, whole);
  EXPECT_GT(std::count(whole.begin(), whole.end(), 1.0F), 0);
  EXPECT_GT(std::count(whole.begin(), whole.end(), 0.0F), 0);
}

TEST_F(Colours, FewVerticesAboveZeroAreSeen) {
  OverlaySpec spec{Overlay::kCost, {}, nullptr};
  spec.measure.importance.criteria = {{"weights", 1}};
  spec.measure.importance.weights.assign(hand_.mesh.vertex_count, 0.0);
  spec.measure.importance.weights[3] = 2;
  const auto colours = make_overlay_colours(spec);
  colours->begin_gop({0, kGop, {}});
  EXPECT_EQ(colour(*colours, 0)[3], 1);
  EXPECT_EQ(colours->legend().largest, 2);
}

TEST_F(Colours, TheScaleGrowsUntilItIsKept) {
  const auto near = make_overlay_colours({Overlay::kError, {}, reference(0.5F, 3)});
  EXPECT_EQ(near->legend().largest, 0);
  colour(*near, 0);
  EXPECT_NEAR(near->legend().largest, 0.5, 1e-5);
  near->keep_scale();
  const double kept = near->legend().largest;
  pushed_.frames[1] = hand_.frames[1];
  pushed_.frames[2][0] += 100;
  EXPECT_EQ(colour(*near, 1), std::vector<float>(hand_.mesh.vertex_count, 0.0F));
  const std::vector<float> far = colour(*near, 2);
  EXPECT_EQ(far[0], 1) << "what is beyond the scale has its last colour";
  EXPECT_EQ(near->legend().largest, kept);
}

TEST_F(Colours, TheScaleIsTheUsersWhereOneIsGiven) {
  const auto colours = make_overlay_colours({Overlay::kError, 2.0, reference(0.5F, 3)});
  EXPECT_NEAR(colour(*colours, 0)[0], 0.25, 1e-5);
  EXPECT_EQ(colours->legend().largest, 2);
}

TEST_F(Colours, ErrorsAreFoundInAnyOrderOfFrames) {
  const auto colours = make_overlay_colours({Overlay::kError, 1.0, reference(0.5F, 5)});
  for (const std::size_t number : {3U, 4U, 0U, 2U, 1U}) {
    EXPECT_NEAR(colour(*colours, number)[0], 0.5, 1e-5) << number;
  }
}

TEST_F(Colours, AReferenceThatDoesNotFitIsAnError) {
  const auto colours = make_overlay_colours({Overlay::kError, {}, reference(0.5F, 5)});
  EXPECT_THROW(colour(*colours, 5), cli::ToolError) << "it has five frames";
  EXPECT_NO_THROW(colour(*colours, 4));
  std::vector<float> values;
  OverlayFrame reordered = frame(4);
  reordered.keeps_vertex_order = false;
  EXPECT_THROW(colours->colour(reordered, values), cli::ToolError);
  Mesh smaller = hand_.mesh;
  --smaller.vertex_count;
  EXPECT_THROW(colours->colour({4, smaller, hand_.frames[4], {}}, values), cli::ToolError);
}

TEST_F(Colours, ImportanceIsYesOrNo) {
  const auto colours = make_overlay_colours({Overlay::kImportance, {}, nullptr});
  OverlayFrame marked = frame(0);
  std::vector<std::uint8_t> flags(hand_.mesh.vertex_count);
  flags[7] = 1;
  marked.flags = flags;
  std::vector<float> values;
  colours->colour(marked, values);
  std::vector<float> expected(flags.size());
  expected[7] = 1;
  EXPECT_EQ(values, expected);
  EXPECT_EQ(colours->legend().map, cli::ColourMap::kFlags);
}

TEST_F(Colours, ImportanceTellsWhatShareTheStreamMarks) {
  OverlayFrame marked = frame(0);
  const auto words = [&marked](const std::vector<std::uint8_t>& flags) {
    const auto colours = make_overlay_colours({Overlay::kImportance, {}, nullptr});
    marked.flags = flags;
    std::vector<float> values;
    colours->colour(marked, values);
    return colours->legend().flagged;
  };
  EXPECT_THAT(words({1, 0, 0, 0}), ::testing::HasSubstr("(fine lattice), 25 %"));
  EXPECT_THAT(words({0, 0, 0, 0}), ::testing::HasSubstr(" 0 %"));
  EXPECT_THAT(words({1, 1, 1, 1}), ::testing::HasSubstr("one lattice"));
}

TEST_F(Colours, NoOverlayHasNone) {
  EXPECT_EQ(make_overlay_colours({}), nullptr);
}

}  // namespace
}  // namespace tvg::player
