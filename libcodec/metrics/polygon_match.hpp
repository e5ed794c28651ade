#pragma once
#include <cstdint>
#include <span>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// How many polygons only one of two meshes has. A polygon is the outline of its triangles, whichever corner
/// it begins with. Each must lie within its mesh's faces.
std::uint64_t unmatched_polygons(std::span<const Face> original_faces, std::span<const Polygon> original,
                                 std::span<const Face> decoded_faces, std::span<const Polygon> decoded);

}  // namespace tvg
