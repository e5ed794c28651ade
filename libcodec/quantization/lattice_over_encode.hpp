#pragma once
#include "quantization/lattice.hpp"

#include <optional>

#include <tvg/geometry.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A lattice over a box that is not empty.
///
/// Without a step: 2^fine_bits cells along the box's longest side, from its smallest corner on.
/// With one: cells of edge `step` (in the box's units; its coarse cells have a finite one) that lie on the
/// grid of all boxes, so that a coordinate falls into the same cell whatever the box, but for rounding where
/// cells meet: coarse cells begin at multiples of their own edge. There are as few bits as hold the box, the
/// coarse ones below the fine ones by as much as asked. Fails with kInvalidArgument when that takes more than
/// kMaxBits bits, and names a step that would do.
Result<Lattice> lattice_over(const BoundingBox& box, int fine_bits, int coarse_bits,
                             std::optional<double> step);

}  // namespace tvg
