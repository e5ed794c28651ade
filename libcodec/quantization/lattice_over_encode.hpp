#pragma once
#include "quantization/lattice.hpp"

#include <optional>

#include <tvg/geometry.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A lattice over a box that is not empty: 2^fine_bits cells along its longest side, or cells of edge `step`
/// (in the box's units) and as many bits as they take, the coarse ones below them by as much as asked. Fails
/// with kInvalidArgument when a step needs more than kMaxBits bits.
Result<Lattice> lattice_over(const BoundingBox& box, int fine_bits, int coarse_bits,
                             std::optional<double> step);

}  // namespace tvg
