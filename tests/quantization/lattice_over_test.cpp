#include "quantization/lattice_over_encode.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace tvg {
namespace {

/// A box with one corner at (1, 2, 3) and these sides.
BoundingBox box_of(float x, float y, float z) {
  BoundingBox box;
  box.extend(std::array<float, 3>{1, 2, 3});
  box.extend(std::array<float, 3>{1 + x, 2 + y, 3 + z});
  return box;
}

TEST(LatticeOverBox, StepIsTheLargestExtentOverTwoToTheBits) {
  const Result<Lattice> lattice = lattice_over(box_of(4, 16, 2), 10, 7, {});
  ASSERT_TRUE(lattice);
  EXPECT_EQ(*lattice, (Lattice{{1, 2, 3}, 16.0 / 1024, 10, 7}));
}

TEST(LatticeOverBox, AStepAsksForAsManyBitsAsItsBoxNeeds) {
  const auto bits = [](float extent, double step) {
    const Result<Lattice> lattice = lattice_over(box_of(1, 1, extent), 11, 11, step);
    EXPECT_TRUE(lattice);
    EXPECT_EQ(lattice->step, step);
    EXPECT_EQ(lattice->coarse_bits, lattice->fine_bits);
    return lattice->fine_bits;
  };
  EXPECT_EQ(bits(10, 0.5), 5) << "21 cells";
  EXPECT_EQ(bits(10, 1.25), 4) << "from 2.5 on, 8 cells and the one that begins at 12.5";
  EXPECT_EQ(bits(7, 1.25), 3) << "from 2.5 on, 6 cells";
  EXPECT_EQ(bits(10, 6), 2) << "from 0 on, 3 cells";
  EXPECT_EQ(bits(10, 1000), 1) << "one bit at least";
  EXPECT_EQ(bits(15.75, std::ldexp(1.0, -20)), 24);
}

TEST(LatticeOverBox, AStepsCoarseCellsBeginAtMultiplesOfTheirEdge) {
  BoundingBox box;
  box.extend(-0.3, 0.9, 4);
  box.extend(2, 2, 5);
  const Result<Lattice> lattice = lattice_over(box, 13, 11, 0.25);
  ASSERT_TRUE(lattice);
  EXPECT_EQ(lattice->origin, (std::array<double, 3>{-1, 0, 4}));
  EXPECT_EQ(lattice->fine_bits, 4);
  EXPECT_EQ(lattice->coarse_bits, 2);
}

TEST(LatticeOverBox, AGridThatBinary64DoesNotHaveBeginsAtTheBox) {
  BoundingBox huge;
  huge.extend(-1.7e308, 0, 0);
  const Result<Lattice> coarse = lattice_over(huge, 1, 1, 1e308);
  ASSERT_TRUE(coarse);
  EXPECT_EQ(coarse->origin[0], -1.7e308);
  for (const double low : {1e9, -1e30}) {
    BoundingBox box;
    box.extend(low, low, low);
    for (const double step : {1e-20, 1e-300}) {
      const Result<Lattice> lattice = lattice_over(box, 24, 1, step);
      ASSERT_TRUE(lattice);
      EXPECT_EQ(lattice->origin[0], low);
    }
  }
}

TEST(LatticeOverBox, AStepKeepsTheDistanceBetweenTheLattices) {
  const Result<Lattice> lattice = lattice_over(box_of(1, 1, 10), 13, 11, 0.01);
  ASSERT_TRUE(lattice);
  EXPECT_EQ(lattice->fine_bits, 10);
  EXPECT_EQ(lattice->coarse_bits, 8);
  const Result<Lattice> wide = lattice_over(box_of(1, 1, 10), 13, 9, 6.0);
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->fine_bits, 5) << "room for a coarse lattice of one bit";
  EXPECT_EQ(wide->coarse_bits, 1);
}

TEST(LatticeOverBox, AStepBelowWhatTheBitsCanHoldIsRefused) {
  for (const double step : {std::ldexp(0.99, -20), 1e-12, 1e-300}) {
    const Result<Lattice> lattice = lattice_over(box_of(1, 1, 16), 11, 11, step);
    ASSERT_FALSE(lattice) << step;
    EXPECT_EQ(lattice.error().code, ErrorCode::kInvalidArgument);
  }
}

TEST(LatticeOverBox, NoExtentStillGivesAUsableLattice) {
  for (const std::optional<double> step : {std::optional<double>(), std::optional<double>(0.25)}) {
    for (const float at : {0.0f, 1.0f, -1e30f, 1e-40f}) {
      BoundingBox box;
      box.extend(std::array<float, 3>{at, at, at});
      const Result<Lattice> lattice = lattice_over(box, 11, 9, step);
      ASSERT_TRUE(lattice);
      EXPECT_GT(lattice->step, 0);
      EXPECT_TRUE(std::isfinite(lattice->step));
      const std::int32_t index = quantize(at, lattice->origin[0], *lattice);
      EXPECT_EQ(index, 0);
      EXPECT_NEAR(reconstruct(index, lattice->origin[0], lattice->step), at,
                  std::max(lattice->step, std::abs(at) * 1e-7));
    }
  }
}

TEST(LatticeOverBox, TheSmallestAndTheLargestExtentsOfFloatWork) {
  BoundingBox tiny, huge;
  tiny.extend(std::array<float, 6>{0, 0, 0, std::numeric_limits<float>::denorm_min(), 0, 0});
  constexpr float kMost = std::numeric_limits<float>::max();
  huge.extend(std::array<float, 6>{-kMost, -kMost, -kMost, kMost, kMost, kMost});
  for (const BoundingBox& box : {tiny, huge}) {
    const Result<Lattice> lattice = lattice_over(box, 24, 1, {});
    ASSERT_TRUE(lattice);
    EXPECT_GT(lattice->step, 0);
    EXPECT_EQ(quantize(box.high()[0], box.low()[0], *lattice), (1 << 24) - 1);
  }
}

}  // namespace
}  // namespace tvg
