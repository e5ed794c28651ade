#pragma once
#include "metrics/surface_index.hpp"

#include <span>

#include <tvg/types.hpp>

namespace tvg {

/// Whether every face names vertices that the mesh has.
bool faces_are_valid(const Mesh& mesh);

/// kInvalidArgument unless there is a position for each vertex of `mesh`, kInvalidInput where one is not
/// finite. `name` is that of the frame in the message: "original".
Status check_positions(const Mesh& mesh, std::span<const float> positions, const char* name);

/// [vertex][xyz] as points, which are as many.
void load_points(std::span<const float> values, Points& points);

/// `value` as a share of `divisor`: 0 where it is 0, else infinite where the divisor is.
double share(double value, double divisor);

}  // namespace tvg
