#include "measure/importance.hpp"

#include "measure/criterion.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <vector>

namespace tvg {
namespace {

using testing::Each;
using testing::ElementsAre;

TEST(FlagHighestShare, FlagsTheVerticesWithTheHighestCost) {
  EXPECT_THAT(flag_highest_share(std::vector<double>{0.1, 0.9, -3, 0.5}, 0.5), ElementsAre(0, 1, 0, 1));
}

TEST(FlagHighestShare, RoundsTheCountToTheNearest) {
  const std::vector<double> cost(10, 1.0);
  const auto count = [&](double share) {
    const std::vector<std::uint8_t> flags = flag_highest_share(cost, share);
    return std::accumulate(flags.begin(), flags.end(), 0);
  };
  EXPECT_EQ(count(0.34), 3);
  EXPECT_EQ(count(0.36), 4);
  EXPECT_EQ(count(0.04), 0);
  EXPECT_EQ(count(0.96), 10);
  EXPECT_EQ(count(0.25), 3) << "a half goes up";
}

TEST(FlagHighestShare, EqualCostsRankByIndexTheLowerFirst) {
  EXPECT_THAT(flag_highest_share(std::vector<double>{1, 2, 1, 2, 1}, 0.6), ElementsAre(1, 1, 0, 1, 0));
  EXPECT_THAT(flag_highest_share(std::vector<double>(4, 7.0), 0.5), ElementsAre(1, 1, 0, 0));
}

TEST(FlagHighestShare, AllOrNoneAtTheEnds) {
  const std::vector<double> cost = {3, 1, 2};
  EXPECT_THAT(flag_highest_share(cost, 0), Each(0));
  EXPECT_THAT(flag_highest_share(cost, 1), Each(1));
  EXPECT_TRUE(flag_highest_share({}, 0.5).empty());
}

TEST(FlagAbove, FlagsOnlyWhatIsAboveTheThreshold) {
  EXPECT_THAT(flag_above(std::vector<double>{0.5, 0.50001, 0.1, -1}, 0.5), ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(flag_above(std::vector<double>{0, -1}, -2), Each(1));
  EXPECT_THAT(flag_above(std::vector<double>{0, 1e300}, std::numeric_limits<double>::infinity()), Each(0));
}

TEST(SmoothCost, IsTheMeanOverAVertexAndItsNeighbours) {
  const Mesh mesh{5, {{0, 1, 2}, {1, 3, 2}}};
  std::vector<double> cost = {9, 0, 3, 6, 7};
  smooth_cost(mesh, 1, cost);
  // Vertex 1 meets 0 and 2 in the first face, 3 and 2 in the second.
  EXPECT_THAT(cost, ElementsAre((9 + 0 + 3) / 3.0, (0 + 9 + 3 + 6 + 3) / 5.0, (3 + 9 + 0 + 0 + 6) / 5.0,
                                (6 + 0 + 3) / 3.0, 7));
}

TEST(SmoothCost, KeepsWhatIsEvenAndGathersWhatIsScattered) {
  Mesh strip{100, {}};
  for (std::uint32_t v = 0; v + 2 < 100; ++v) strip.faces.push_back({v, v + 1, v + 2});
  std::vector<double> even(100, 2.5);
  smooth_cost(strip, 7, even);
  EXPECT_THAT(even, Each(testing::DoubleNear(2.5, 1e-12)));
  // Every third vertex counts among the first fifty: by themselves they are alone, smoothed they are a piece.
  std::vector<double> scattered(100, 0.0);
  for (std::size_t v = 0; v < 50; v += 3) scattered[v] = 1;
  smooth_cost(strip, 10, scattered);
  const std::vector<std::uint8_t> flags = flag_highest_share(scattered, 0.4);
  EXPECT_EQ(std::count(flags.begin(), flags.begin() + 45, 1), 40);
  std::vector<double> untouched = {1, 2};
  smooth_cost(Mesh{2, {{0, 1, 1}}}, 0, untouched);
  EXPECT_THAT(untouched, ElementsAre(1, 2));
}

TEST(Cost, IsEquation2WithWeightsOfEitherSign) {
  const Criterion ramp{"ramp", "1, 2, 3, ...", [](const CriterionInput& input) {
                         std::vector<double> values(input.mesh().vertex_count);
                         std::iota(values.begin(), values.end(), 1.0);
                         return values;
                       }};
  const Criterion alpha{"alpha", "constant", [](const CriterionInput& input) {
                          return std::vector<double>(input.mesh().vertex_count, input.options.curv.alpha);
                        }};
  const Mesh mesh{3, {}};
  Importance options;
  options.curv.alpha = 0.25;
  const Skeleton none;
  const Topology topology(mesh);
  const CriterionInput input{topology, {}, options, none, {}, {}};
  EXPECT_THAT(cost(std::vector<WeightedCriterion>{{&ramp, 2}, {&alpha, -4}}, input), ElementsAre(1, 3, 5));
  EXPECT_THAT(cost(std::vector<WeightedCriterion>{{&ramp, -1}}, input), ElementsAre(-1, -2, -3));
  EXPECT_THAT(cost({}, input), Each(0));
}

TEST(Criteria, AreNamedDifferentlyAndBeginWithCurvature) {
  ASSERT_FALSE(criteria().empty());
  EXPECT_EQ(criteria().front().name, "curv");
  for (const Criterion& a : criteria()) {
    EXPECT_EQ(std::count_if(criteria().begin(), criteria().end(),
                            [&](const Criterion& b) { return a.name == b.name; }),
              1);
    EXPECT_NE(a.evaluate, nullptr);
  }
}

}  // namespace
}  // namespace tvg
