#pragma once
#include <span>

#include <tvg/types.hpp>

namespace tvg {

/// Unit normals of a frame's vertices: the sum of the normals of the faces around each, weighted by their
/// areas. `positions` and `normals` are [vertex][xyz] and of equal size; every index in `faces` is within
/// them. A vertex without a face of non-zero area gets (0, 0, 0). Does not allocate.
void vertex_normals(std::span<const Face> faces, std::span<const float> positions, std::span<float> normals);

}  // namespace tvg
