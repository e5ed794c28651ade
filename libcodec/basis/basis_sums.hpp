#pragma once
#include "basis/basis_header.hpp"
#include "basis/coefficient_planes.hpp"
#include "basis/pair_sums.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// A frame from a basis: for each coordinate, the sum of all coefficients times the rows of the frame
// (format-spec §7.8.5). Sums are exact, so that their order does not matter: nearly all of it is done in
// products of 16 bits, rows in two parts of which the lower one is mostly zero.
namespace tvg {

class BasisSums {
 public:
  /// [axis][vertex of a block]: in 2^-fraction_bits of a step; whole numbers below 2^52, which binary64 has.
  using SumBlock = std::array<std::array<double, CoefficientPlanes::kAtOnce>, 3>;

  /// What is allocated for so many components.
  static constexpr std::uint64_t bytes(std::uint64_t components) { return (components + 2) * 48; }

  /// Makes room for frames of a basis with so many components; false where there is none.
  bool reserve(std::size_t components);

  /// Takes the rows of a frame, [row][xyz], which have these scales. False where a sum could be 2^52 or more,
  /// which the format does not allow.
  bool take(const CoefficientPlanes& planes, Bytes scales, std::span<const std::int32_t> rows);

  /// The sums of the vertices of a block.
  void sum(const CoefficientPlanes& planes, std::size_t block, SumBlock& sums) const;

 private:
  void split(const CoefficientPlanes& planes);
  void sum_pairs(const CoefficientPlanes::PairBlock* pairs, SumBlock& sums) const;
  void sum_plainly(const CoefficientPlanes& planes, const CoefficientPlanes::PairBlock* pairs,
                   SumBlock& sums) const;

  bool within_32_bits_ = false;  ///< sums of products of the parts are
  int low_bits_ = 0;             ///< of a row's lower part
  using Factors = std::array<std::int64_t, 3>;
  Factors mean_{};
  std::vector<Factors> factors_;  ///< [component]
  std::vector<RowPair> high_;     ///< [pair] the upper parts
  std::vector<LowPair> low_;      ///< the lower ones of pairs that have any
};

}  // namespace tvg
