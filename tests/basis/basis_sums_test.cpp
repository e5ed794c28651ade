#include "basis/basis_sums.hpp"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {
namespace {

/// A basis of random planes, and the rows of a frame.
struct RandomBasis {
  RandomBasis(std::size_t vertex_count, std::size_t component_count, std::int32_t most, std::int32_t most_row,
              int most_shift, std::uint32_t seed)
      : vertices(vertex_count), components(component_count), random(seed) {
    for (std::size_t group = 0; 4 * group < components; ++group) {
      groups.emplace_back(vertices);
      for (Quad& quad : groups.back()) {
        for (std::size_t j = 0; j < 4 && 4 * group + j < components; ++j)
          quad[j] = between(most >> (2 * group));
      }
    }
    for (std::size_t row = 0; row <= components; ++row) {
      scales.push_back(static_cast<std::uint8_t>(random() % static_cast<unsigned>(4 * most_shift + 4)));
      for (int axis = 0; axis < 3; ++axis) rows.push_back(between(most_row));
    }
  }

  std::int32_t between(std::int32_t most) {
    return std::uniform_int_distribution<std::int32_t>(-most, most)(random);
  }

  std::int64_t expected(std::size_t v, std::size_t axis) const {
    std::int64_t sum = rows[axis] * RowScale{scales[0]}.factor();
    for (std::size_t a = 0; a < components; ++a) {
      sum += groups[a / 4][v][a % 4] * (rows[3 * (a + 1) + axis] * RowScale{scales[a + 1]}.factor());
    }
    return sum;
  }

  std::size_t vertices, components;
  std::mt19937 random;
  std::vector<std::vector<Quad>> groups;
  std::vector<std::uint8_t> scales;
  std::vector<std::int32_t> rows;
};

/// Whether the rows are taken; where they are, all sums must be exact.
bool check(const RandomBasis& basis) {
  CoefficientPlanes planes;
  EXPECT_TRUE(planes.reserve(basis.vertices, basis.components));
  for (std::size_t group = 0; group < basis.groups.size(); ++group)
    EXPECT_TRUE(planes.put(group, basis.groups[group]));
  BasisSums sums;
  EXPECT_TRUE(sums.reserve(basis.components));
  if (!sums.take(planes, basis.scales, basis.rows)) return false;
  BasisSums::SumBlock block_sums;
  for (std::size_t v = 0; v < basis.vertices; ++v) {
    sums.sum(planes, v / CoefficientPlanes::kAtOnce, block_sums);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(block_sums[axis][v % CoefficientPlanes::kAtOnce],
                static_cast<double>(basis.expected(v, axis)))
          << "vertex " << v << " axis " << axis;
    }
  }
  return true;
}

TEST(BasisSums, AreExactForSmallAndLargeCoefficientsAndRows) {
  std::uint32_t seed = 1;
  for (const std::size_t components : {0u, 1u, 2u, 7u, 40u}) {
    for (const std::int32_t most : {1, 300, 32767, 32768, 1 << 20}) {
      for (const std::int32_t most_row : {1, 1000, 40000, 1 << 22}) {
        SCOPED_TRACE(testing::Message() << components << ' ' << most << ' ' << most_row);
        EXPECT_TRUE(check(RandomBasis(19, components, most, most_row, 2, ++seed)));
      }
    }
  }
}

TEST(BasisSums, AreExactWhereSumsOfSixteenBitsDoNotFitThirtyTwo) {
  RandomBasis basis(9, 60, 32767, 32767, 0, 7);
  for (std::vector<Quad>& group : basis.groups) group.assign(group.size(), {32767, -32767, 32767, -32767});
  for (std::size_t i = 0; i < basis.rows.size(); ++i) basis.rows[i] = i / 3 % 2 == 0 ? -(1 << 24) : 1 << 24;
  EXPECT_TRUE(check(basis));
}

TEST(BasisSums, AreTheSameInTheWidestInstructionsOfTheMachine) {
  std::mt19937 random(11);
  const auto pair = [&random] {
    return CoefficientPlanes::Pair{static_cast<std::int16_t>(random()), static_cast<std::int16_t>(random())};
  };
  for (const std::size_t pairs : {0u, 1u, 2u, 17u}) {
    std::vector<CoefficientPlanes::PairBlock> block(pairs);
    std::vector<RowPair> high(pairs);
    std::vector<LowPair> low;
    for (std::size_t i = 0; i < pairs; ++i) {
      for (CoefficientPlanes::Pair& values : block[i]) values = pair();
      // Small enough that no sum leaves 32 bits.
      for (std::size_t axis = 0; axis < 3; ++axis)
        high[i][axis] = {static_cast<std::int16_t>(random() % 2048),
                         static_cast<std::int16_t>(random() % 2048)};
      if (i % 3 == 0) low.push_back({static_cast<std::uint32_t>(i), high[i]});
    }
    PairSums upper, lower, plain_upper, plain_lower;
    add_pairs(block.data(), high, low, upper, lower);
    add_pairs_plainly(block.data(), high, low, plain_upper, plain_lower);
    EXPECT_EQ(upper, plain_upper) << pairs;
    EXPECT_EQ(lower, plain_lower) << pairs;
  }
}

TEST(BasisSums, RefuseRowsWhoseSumsCouldLeaveBinary64) {
  RandomBasis basis(3, 2, 1, 1, 0, 9);
  basis.groups[0].assign(3, {1 << 20, 1, 0, 0});
  basis.rows.assign(9, 0);
  basis.rows[3] = 1 << 26;
  basis.scales = {0, 12, 0};
  EXPECT_TRUE(check(basis));
  basis.scales = {0, 16, 0};
  EXPECT_FALSE(check(basis)) << "2^20 * 2^26 * 4 * 2^4 is 2^52";
  basis.scales = {0, RowScale::kMost, 0};
  EXPECT_FALSE(check(basis));
  basis.scales = {RowScale::kMost, 0, 0};
  basis.rows.assign(9, 0);
  basis.rows[0] = 1 << 26;
  EXPECT_FALSE(check(basis)) << "the mean alone";
}

}  // namespace
}  // namespace tvg
