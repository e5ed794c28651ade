#pragma once
#include "prediction/pyramid.hpp"
#include "prediction/surface_graph.hpp"

#include <cstdint>
#include <span>

namespace tvg {

/// Weights that predict a point from others around it, in 2^-14, of sum 2^14: kriging with a kernel that asks
/// for smoothness and, far more, for affine functions to be met (format-spec §5.4.4). At least one point, at
/// most kMaxPyramidNeighbours; `weights` has as many. binary64 in a fixed order, so the same everywhere.
void krige(const ShapePoint& point, std::span<const ShapePoint> around, std::span<std::int16_t> weights);

}  // namespace tvg
