#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <tvg/geometry.hpp>

namespace tvg {
namespace {

using Corner = std::array<double, 3>;

TEST(BoundingBox, GrowsOverVerticesAndFrames) {
  BoundingBox box;
  box.extend(std::vector<float>{0, 5, -1, 2, 4, -3});
  box.extend(std::vector<float>{-1, 4.5f, 7});
  EXPECT_EQ(box.low(), (Corner{-1, 4, -3}));
  EXPECT_EQ(box.high(), (Corner{2, 5, 7}));
  EXPECT_EQ(box.center(), (Corner{0.5, 4.5, 2}));
  EXPECT_EQ(box.largest_extent(), 10);
  EXPECT_DOUBLE_EQ(box.diagonal(), std::sqrt(9.0 + 1 + 100));
  const std::vector<FramePositions> frames = {{0, 5, -1, 2, 4, -3}, {-1, 4.5f, 7}};
  EXPECT_EQ(box_around(frames).low(), box.low());
  EXPECT_EQ(box_around(frames).high(), box.high());
}

TEST(BoundingBox, OfNothingHasNoExtent) {
  BoundingBox box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.largest_extent(), 0);
  EXPECT_EQ(box.diagonal(), 0);
  box.extend(1, 2, 3);
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.low(), (Corner{1, 2, 3}));
  EXPECT_EQ(box.diagonal(), 0);
}

TEST(BoundingBox, PassesOverPointsThatAreNowhere) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  BoundingBox box;
  box.extend(std::vector<float>{kInfinity, 1, 1, 2, 3, 4, 9, std::nanf(""), 9, 9, 9, -kInfinity});
  EXPECT_EQ(box.low(), (Corner{2, 3, 4}));
  EXPECT_EQ(box.high(), (Corner{2, 3, 4}));
}

TEST(BoundingBox, HoldsTheLargestFloats) {
  constexpr float kMost = std::numeric_limits<float>::max();
  BoundingBox box;
  box.extend(std::vector<float>{-kMost, -kMost, -kMost, kMost, kMost, kMost});
  EXPECT_EQ(box.largest_extent(), 2.0 * kMost);
  EXPECT_TRUE(std::isfinite(box.diagonal()));
}

TEST(BoundingBox, IsPaddedAtBothEnds) {
  BoundingBox box;
  box.extend(0, 0, 0);
  box.extend(1, 2, 3);
  box.pad(0.5);
  EXPECT_EQ(box.low(), (Corner{-0.5, -0.5, -0.5}));
  EXPECT_EQ(box.high(), (Corner{1.5, 2.5, 3.5}));
}

}  // namespace
}  // namespace tvg
