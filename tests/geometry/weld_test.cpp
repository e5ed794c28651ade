#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include <tvg/geometry.hpp>

namespace tvg {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Weld, NumbersPointsByFirstAppearance) {
  const Weld weld = weld_positions(std::vector<float>{1, 2, 3, 0, 0, 0, 1, 2, 3, 0, 0, 0.5f, 0, 0, 0});
  EXPECT_THAT(weld.vertex_of_point, ElementsAre(0, 1, 0, 2, 1));
  EXPECT_THAT(weld.first_point, ElementsAre(0, 1, 3));
  EXPECT_EQ(weld.vertex_count(), 3u);
}

TEST(Weld, OfPositionsIsToTheBit) {
  EXPECT_EQ(weld_positions(std::vector<float>{0, 0, 0, -0.0f, 0, 0}).vertex_count(), 2u);
}

TEST(Weld, OfNothingIsNothing) {
  EXPECT_THAT(weld_positions({}).vertex_of_point, IsEmpty());
}

TEST(Weld, OnlyAsksForEqualityWhereHashesCollide) {
  const std::vector<int> values = {4, 7, 4, 8, 7};
  const auto equal = [&values](std::uint32_t a, std::uint32_t b) { return values[a] == values[b]; };
  const auto all_alike = [](std::uint32_t) { return std::uint64_t{3}; };
  EXPECT_THAT(weld_points(5, all_alike, equal).vertex_of_point, ElementsAre(0, 1, 0, 2, 1));
}

}  // namespace
}  // namespace tvg
