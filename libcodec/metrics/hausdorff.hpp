#pragma once
#include "metrics/surface_index.hpp"

#include <span>

#include <tvg/types.hpp>

namespace tvg {

/// The largest distance from a sample of the surface (faces, from) to the surface (faces, to): exact for
/// these samples, every vertex that a face uses and every face's centroid. `faces` must not be empty, its
/// indices valid.
double directed_hausdorff(std::span<const Face> faces, const Points& from, const Points& to);

}  // namespace tvg
