#pragma once
#include "planes/coefficient_coder.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tvg {

/// How coefficients are quantized.
struct CoefficientQuality {
  double step = 1;  ///< of coefficients
  /// What a bit may cost: so many times ln 2 / 6 of a squared step. 1 is what a bit brings where cells are
  /// all small; more makes for finer steps and more residuals that are zero.
  double thrift = 2;
};

/// The coefficients of a basis as they are weighed: planes by falling energy.
struct Coefficients {
  const Pyramid& pyramid;
  std::span<const std::uint8_t> flags;     ///< [vertex]; empty where there is one lattice
  int nested_bits = 0;                     ///< between the two
  const Eigen::MatrixXf& values;           ///< [vertex][component], each vertex times its weight
  std::span<const double> energies;        ///< [component] sum of squares
  double total = 0;                        ///< that of all there are, with those that are not here
  std::span<const std::size_t> part_ends;  ///< [part] the turn it ends before; see CoefficientCoder

  /// Bits between the lattice of a vertex and the fine one.
  int shift_of(std::size_t vertex) const { return flags.empty() || flags[vertex] != 0 ? 0 : nested_bits; }
};

/// Planes of a basis, coded.
struct CodedCoefficients {
  std::size_t components = 0;
  std::vector<std::vector<std::vector<std::uint8_t>>> groups;  ///< [group][part]
  std::vector<std::vector<Quad>> values;                       ///< [group][vertex] on the fine lattice
  double error = 0;       ///< sum of squares with what was left out, in the units of the coefficients
  std::size_t bytes = 0;  ///< of the groups
};

/// Quantizes and codes components for as long as a group of them is worth its bits, those of its rows
/// included, which `row_bits(component)` tells. Each coefficient becomes what costs least: its error, and its
/// bits by the models as they are by then.
CodedCoefficients code_coefficients(const Coefficients& coefficients, const CoefficientQuality& quality,
                                    const std::function<double(std::size_t)>& row_bits);

}  // namespace tvg
