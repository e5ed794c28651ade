#pragma once
#include "basis/basis_header.hpp"
#include "basis/coefficient_choice_encode.hpp"
#include "basis/principal_components_encode.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tvg {

/// A basis that fits the trajectories of a period, quantized. Lengths are in steps of the trajectories.
struct FittedBasis {
  CodedCoefficients coefficients;
  double step = 1;  ///< of coefficients
  int fraction_bits = 0;
  std::vector<std::uint8_t> scales;  ///< [row]
  std::vector<std::int32_t> rows;    ///< [frame][row][xyz]
  double squared_error = 0;  ///< sum over all coordinates, each times the square of its vertex's weight
  double largest_error = 0;  ///< of any coordinate, times its vertex's weight
};

/// What a basis must achieve, in steps of the trajectories.
struct FitTarget {
  double squared_error = 0;             ///< at most this in sum
  std::optional<double> largest_error;  ///< instead: at most this of any coordinate
};

/// How hard to look for the smallest.
struct FitEffort {
  std::vector<double> thrifts = {3};  ///< CoefficientQuality::thrift to try; the smallest stream is kept
  int tries = 6;                      ///< of steps for each
};

/// The basis whose stream is smallest of those that were tried and hit the target. `pyramid` and `flags` are
/// those of the vertices, in their order; `part_ends` are those of CoefficientCoder, at least one. Where no
/// step is fine enough, `squared_error` or `largest_error` of the result are above the target.
FittedBasis fit_basis(const Trajectories& trajectories, const Pyramid& pyramid,
                      std::span<const std::size_t> part_ends, std::span<const std::uint8_t> flags,
                      int nested_bits, const FitTarget& target, const FitEffort& effort);

}  // namespace tvg
