#include "measure_toolbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace tvg {
namespace {

using test::evaluate;
using testing::Each;
using testing::ElementsAre;

const Mesh kPoints{2, {}};

TEST(Velocity, IsTheMeanWayPerFrameAsAShareOfTheDiagonal) {
  // The box is 3 x 4 x 0: its diagonal is 5. Vertex 0 goes 3 and 4, vertex 1 rests.
  const std::vector<FramePositions> frames = {{0, 0, 0, 0, 0, 0}, {3, 0, 0, 0, 0, 0}, {3, 4, 0, 0, 0, 0}};
  const std::vector<double> speed = evaluate("velocity", kPoints, frames);
  EXPECT_DOUBLE_EQ(speed[0], 3.5 / 5);
  EXPECT_EQ(speed[1], 0);
}

TEST(Velocity, IsZeroInOneFrameAndWithoutExtent) {
  EXPECT_THAT(evaluate("velocity", kPoints, {{0, 0, 0, 1, 1, 1}}), Each(0));
  EXPECT_THAT(evaluate("velocity", kPoints, {{2, 2, 2, 2, 2, 2}, {2, 2, 2, 2, 2, 2}}), Each(0));
}

TEST(Distance, IsTheMeanOverTheFramesAsAShareOfTheDiagonal) {
  Importance options;
  options.distance.viewpoint = {0, 0, -3};
  // Box 4 x 0 x 3. Vertex 0: 5 and 3 away; vertex 1: 3 and 6.
  const std::vector<FramePositions> frames = {{4, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 3}};
  const std::vector<double> distance = evaluate("distance", kPoints, frames, options);
  EXPECT_DOUBLE_EQ(distance[0], 4.0 / 5);
  EXPECT_DOUBLE_EQ(distance[1], 4.5 / 5);
  EXPECT_THAT(evaluate("distance", kPoints, {{1, 1, 1, 1, 1, 1}}, options), Each(0));
}

TEST(Distance, FavoursNearVerticesWithANegativeWeight) {
  Importance importance;
  importance.distance.viewpoint = {0, 0, 0};
  importance.share = 0.5;
  const std::vector<FramePositions> frames = {{1, 0, 0, 9, 0, 0}};
  importance.criteria = {{"distance", 1}};
  EXPECT_THAT(measure(kPoints, frames, {}, {}, importance)->flags, ElementsAre(0, 1));
  importance.criteria = {{"distance", -1}};
  EXPECT_THAT(measure(kPoints, frames, {}, {}, importance)->flags, ElementsAre(1, 0));
  importance.distance.viewpoint[1] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(measure(kPoints, frames, {}, {}, importance));
}

TEST(Weights, AreTheCostAsTheyAre) {
  Importance importance;
  importance.criteria = {{"weights", 2}, {"velocity", -1}};
  importance.weights = {0.25, -3};
  const auto measured = measure(kPoints, std::vector<FramePositions>{{0, 0, 0, 1, 1, 1}}, {}, {}, importance);
  ASSERT_TRUE(measured);
  EXPECT_THAT(measured->cost, ElementsAre(0.5, -6));
}

TEST(Weights, MustBeOnePerVertexAndFinite) {
  Importance importance;
  importance.criteria = {{"weights", 1}};
  const auto message = [&] { return check_importance(importance, kPoints, {}).error().message; };
  EXPECT_THAT(message(), testing::HasSubstr("0 weights for the mesh's 2 vertices"));
  importance.weights = {1, 2, 3};
  EXPECT_THAT(message(), testing::HasSubstr("3 weights"));
  importance.weights = {1, std::nan("")};
  EXPECT_THAT(message(), testing::HasSubstr("vertex 1"));
}

TEST(CheckImportance, RefusesCriteriaThatAreNotThere) {
  const auto code = [](std::vector<CriterionWeight> criteria) {
    Importance importance;
    importance.criteria = std::move(criteria);
    const Status status = check_importance(importance, kPoints, {});
    return status.ok() ? 0 : static_cast<int>(status.error().code);
  };
  const int wrong = static_cast<int>(ErrorCode::kInvalidArgument);
  EXPECT_EQ(code({{"curv", -2}}), 0);
  EXPECT_EQ(code({}), wrong);
  EXPECT_EQ(code({{"Curv", 1}}), wrong);
  EXPECT_EQ(code({{"", 1}}), wrong);
  EXPECT_EQ(code({{"curv", std::nan("")}}), wrong);
  EXPECT_EQ(code({{"curv", 1}, {"velocity", std::numeric_limits<double>::infinity()}}), wrong);
}

TEST(CheckImportance, RefusesMoreSmoothingThanAnyoneNeeds) {
  Importance importance;
  importance.smoothing = kMaxSmoothing;
  EXPECT_TRUE(check_importance(importance, kPoints, {}).ok());
  importance.smoothing = kMaxSmoothing + 1;
  EXPECT_FALSE(check_importance(importance, kPoints, {}).ok());
}

TEST(MeasureOfFrames, RefusesSizesThatDoNotFit) {
  Importance importance;
  const std::vector<FramePositions> frames(2, FramePositions(6));
  EXPECT_TRUE(measure(kPoints, frames, {}, {}, importance));
  EXPECT_FALSE(measure(kPoints, {}, {}, {}, importance));
  EXPECT_FALSE(measure(Mesh{3, {}}, frames, {}, {}, importance));
  importance.criteria = {{"skel", 1}};
  EXPECT_TRUE(measure(kPoints, frames, test::arm(), test::Joints(2, test::bent_arm(0)), importance));
  EXPECT_FALSE(measure(kPoints, frames, test::arm(), test::Joints(1, test::bent_arm(0)), importance));
  EXPECT_FALSE(measure(kPoints, frames, test::arm(), test::Joints(2, {0, 0, 0}), importance));
}

TEST(MeasureOfFrames, ReportsJointsOnlyWhereACriterionUsesThem) {
  Importance importance;
  const std::vector<FramePositions> frames(2, FramePositions(6));
  const test::Joints joints = {test::bent_arm(0), test::bent_arm(10)};
  EXPECT_TRUE(measure(kPoints, frames, test::arm(), joints, importance)->joints.empty());
  importance.criteria.push_back({"skel", 0.5});
  const auto measured = measure(kPoints, frames, test::arm(), joints, importance);
  ASSERT_EQ(measured->joints.size(), 3U);
  EXPECT_NEAR(measured->joints[1].angle_sum, 10, 1e-4);
  EXPECT_TRUE(measured->joints[1].dynamic);
}

}  // namespace
}  // namespace tvg
