#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include <tvg/types.hpp>

// The integer lattice positions are quantized to (format-spec §7.1), in one or two nested resolutions.
namespace tvg {

/// A cubic lattice that covers a bounding box: cell i of an axis covers [origin + i step, origin + (i + 1)
/// step).
struct Lattice {
  std::array<double, 3> origin{};  ///< smallest corner of the lattice, in the mesh's units
  double step = 1;                 ///< edge of a fine cell (B2), in the mesh's units; positive
  int fine_bits = 11;              ///< B2: important vertices have indices below 2^B2
  int coarse_bits = 11;            ///< B1 <= B2: the other vertices have indices below 2^B1

  /// Fine cells per coarse cell and axis, as a power of two.
  int shift() const { return fine_bits - coarse_bits; }
  bool hybrid() const { return fine_bits != coarse_bits; }

  bool operator==(const Lattice&) const = default;
};

// Algorithm 2: bringing a neighbour's index to the lattice of the vertex that is predicted.

/// An index of the coarse lattice on the fine one: the low bits are padded with zeros.
constexpr std::int32_t pad_to_fine(std::int32_t coarse_index, int shift) {
  return coarse_index << shift;
}
/// An index of the fine lattice on the coarse one: the low bits are shifted out.
constexpr std::int32_t shift_to_coarse(std::int32_t fine_index, int shift) {
  return fine_index >> shift;
}

/// Index of a coordinate on the fine lattice (Algorithm 1): floor((x - origin) / step), clamped to the
/// lattice.
inline std::int32_t quantize(double coordinate, double origin, const Lattice& lattice) {
  const double cells = (coordinate - origin) / lattice.step;
  const std::int32_t last = static_cast<std::int32_t>((std::int64_t{1} << lattice.fine_bits) - 1);
  // Between the bounds, what a conversion cuts off is what floor() would.
  return cells < 0 ? 0 : cells >= last ? last : static_cast<std::int32_t>(cells);
}

/// Centre of a cell, in the order of operations that every decoder uses: origin + (index + 0.5) * step in
/// binary64, rounded once to float32. `step` is that of the index's own lattice.
inline float reconstruct(std::int32_t index, double origin, double step) {
  const double centre = origin + (static_cast<double>(index) + 0.5) * step;
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(centre > kLargest ? kLargest : centre < -kLargest ? -kLargest : centre);
}

}  // namespace tvg
