#pragma once
#include "quantization/lattice.hpp"

#include <array>
#include <optional>
#include <span>

#include <tvg/types.hpp>

namespace tvg {

/// An axis-aligned box that grows with the frames it is shown.
class BoundingBox {
 public:
  BoundingBox();

  /// `positions`: [vertex][xyz].
  void extend(std::span<const float> positions);
  /// The longest side; 0 when all positions are one point.
  double largest_extent() const;

  const std::array<double, 3>& low() const { return low_; }
  const std::array<double, 3>& high() const { return high_; }

 private:
  std::array<double, 3> low_, high_;
};

/// A lattice over a box that is not empty: 2^fine_bits cells along its longest side, or cells of edge `step`
/// (in the box's units) and as many bits as they take, the coarse ones below them by as much as asked. Fails
/// with kInvalidArgument when a step needs more than kMaxBits bits.
Result<Lattice> lattice_over(const BoundingBox& box, int fine_bits, int coarse_bits,
                             std::optional<double> step);

}  // namespace tvg
