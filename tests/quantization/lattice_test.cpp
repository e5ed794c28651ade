#include "quantization/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>

namespace tvg {
namespace {

Lattice lattice_of(double origin, double step, int fine_bits, int coarse_bits) {
  return {{origin, origin, origin}, step, fine_bits, coarse_bits};
}

TEST(Lattice, QuantizesAsAlgorithm1WorkedByHand) {
  // A box from 10 to 18 with 3 bits: 8 cells of edge 1.
  const Lattice lattice = lattice_of(10, 1, 3, 3);
  EXPECT_EQ(quantize(10.0, 10, lattice), 0);
  EXPECT_EQ(quantize(10.999, 10, lattice), 0) << "the floor, not the nearest";
  EXPECT_EQ(quantize(11.0, 10, lattice), 1) << "a border belongs to the cell above it";
  EXPECT_EQ(quantize(14.5, 10, lattice), 4);
  EXPECT_EQ(quantize(17.999, 10, lattice), 7);
  EXPECT_EQ(quantize(18.0, 10, lattice), 7) << "the box's upper end is in the last cell";
}

TEST(Lattice, CoordinatesOutsideTheBoxGoToTheNearestCell) {
  const Lattice lattice = lattice_of(-1, 0.25, 4, 4);
  EXPECT_EQ(quantize(-1.0001, -1, lattice), 0);
  EXPECT_EQ(quantize(-1e30, -1, lattice), 0);
  EXPECT_EQ(quantize(3.01, -1, lattice), 15);
  EXPECT_EQ(quantize(1e30, -1, lattice), 15);
}

TEST(Lattice, QuantizesToTheFloorOfTheQuotientAsBinary64HasIt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-0.1, 1.1), exponent(-30, 30);
  for (int round = 0; round < 20000; ++round) {
    const double step = std::exp2(exponent(random)), origin = anywhere(random) * step * 1e4;
    const Lattice lattice{{}, step, 1 + static_cast<int>(random() % 24), 1};
    const double cells = std::exp2(lattice.fine_bits) * anywhere(random);
    const double whole = std::floor(cells) * step;
    for (const double x : {origin + cells * step, origin + whole, std::nextafter(origin + whole, -1e300)}) {
      const double expected =
          std::clamp(std::floor((x - origin) / step), 0.0, std::exp2(lattice.fine_bits) - 1);
      ASSERT_EQ(quantize(x, origin, lattice), static_cast<std::int32_t>(expected));
    }
  }
}

TEST(Lattice, ReconstructsAtTheCentreOfTheCell) {
  EXPECT_EQ(reconstruct(0, 10, 1), 10.5f);
  EXPECT_EQ(reconstruct(7, 10, 1), 17.5f);
  EXPECT_EQ(reconstruct(3, -1, 0.25), -0.125f);
}

TEST(Lattice, ReconstructionNeverLeavesTheRangeOfFloat) {
  EXPECT_EQ(reconstruct(1 << 23, 3e38, 1e37), std::numeric_limits<float>::max());
  EXPECT_EQ(reconstruct(0, -1e39, 1e30), -std::numeric_limits<float>::max());
  EXPECT_TRUE(std::isfinite(reconstruct(1 << 23, 0, std::numeric_limits<double>::max())));
}

TEST(Lattice, ErrorIsAtMostHalfAStepAtEveryNumberOfBits) {
  std::mt19937 random(1);
  for (int bits = kMinBits; bits <= kMaxBits; ++bits) {
    std::uniform_real_distribution<double> inside(-3, 5);
    const Lattice lattice = lattice_of(-3, 8.0 / std::ldexp(1.0, bits), bits, bits);
    for (int i = 0; i < 2000; ++i) {
      const double x = i == 0 ? -3 : i == 1 ? 5 : inside(random);
      const std::int32_t index = quantize(x, -3, lattice);
      ASSERT_GE(index, 0);
      ASSERT_LT(index, 1 << bits);
      ASSERT_LE(std::abs(-3 + (index + 0.5) * lattice.step - x), lattice.step / 2 * (1 + 1e-9)) << bits;
      const double rounding = 5 * std::ldexp(1.0, -24);
      ASSERT_LE(std::abs(double{reconstruct(index, -3, lattice.step)} - x), lattice.step / 2 + rounding)
          << bits;
    }
  }
}

TEST(Lattice, CoarseLatticeIsNestedInTheFineOne) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> inside(0, 1);
  for (int fine = 2; fine <= kMaxBits; ++fine) {
    for (int coarse = 1; coarse <= fine; ++coarse) {
      const Lattice lattice = lattice_of(0, std::ldexp(1.0, -fine), fine, coarse);
      const Lattice coarse_lattice = lattice_of(0, std::ldexp(1.0, -coarse), coarse, coarse);
      for (int i = 0; i < 20; ++i) {
        const double x = inside(random);
        ASSERT_EQ(shift_to_coarse(quantize(x, 0, lattice), lattice.shift()), quantize(x, 0, coarse_lattice));
      }
    }
  }
}

TEST(Lattice, PadsAndShiftsAsAlgorithm2WorkedByHand) {
  // 13 and 11 bits: four fine cells in a coarse one.
  const Lattice lattice = lattice_of(0, 1, 13, 11);
  ASSERT_EQ(lattice.shift(), 2);
  EXPECT_EQ(pad_to_fine(1234, 2), 4936);
  EXPECT_EQ(shift_to_coarse(4936, 2), 1234);
  EXPECT_EQ(shift_to_coarse(4939, 2), 1234);
  EXPECT_EQ(shift_to_coarse(4940, 2), 1235);
  EXPECT_EQ(pad_to_fine(shift_to_coarse(4939, 2), 2), 4936) << "padding fills in zeros";
  EXPECT_EQ(pad_to_fine(77, 0), 77);
  EXPECT_EQ(shift_to_coarse(77, 0), 77);
}

TEST(Lattice, IsHybridOnlyWhenItsBitsDiffer) {
  EXPECT_FALSE(lattice_of(0, 1, 9, 9).hybrid());
  EXPECT_TRUE(lattice_of(0, 1, 9, 8).hybrid());
}

}  // namespace
}  // namespace tvg
