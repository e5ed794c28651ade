#pragma once
#include "basis/coefficient_planes.hpp"

#include <array>
#include <cstdint>
#include <span>

// Sums of products of 16 bits, eight vertices and two components at a time: what a frame of a basis takes
// nearly all of its time for.
namespace tvg {

/// What two neighbouring components are multiplied by, for x, y and z.
using RowPair = std::array<CoefficientPlanes::Pair, 4>;
/// The same of some pair of components.
struct LowPair {
  std::uint32_t pair;
  RowPair rows;
};

/// [axis][vertex of a block]
using PairSums = std::array<std::array<std::int32_t, CoefficientPlanes::kAtOnce>, 3>;

/// The sums of all of a block's pairs, [pair], times their rows, and of some of them times their lower rows.
/// None may leave 32 bits.
void add_pairs_plainly(const CoefficientPlanes::PairBlock* pairs, std::span<const RowPair> high,
                       std::span<const LowPair> low, PairSums& upper, PairSums& lower);

/// The same, in instructions of AVX2 where the processor has them.
void add_pairs(const CoefficientPlanes::PairBlock* pairs, std::span<const RowPair> high,
               std::span<const LowPair> low, PairSums& upper, PairSums& lower);

}  // namespace tvg
