#pragma once
#include "decoder/exporters/mesh_writers.hpp"

#include <tvg/measure.hpp>

namespace tvg::cli {

/// What colours a PLY.
enum class MeasureColour { kCost, kFlags };

/// What a PLY says of the vertices in any frame of a GOP: a colour, and the properties `cost` and `important`
/// (1 or 0).
VertexAttributes ply_attributes(const Measure& measure, MeasureColour colour);

}  // namespace tvg::cli
