#pragma once
#include "attributes/property_mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

struct EncodedPolygons {
  std::vector<std::uint8_t> section;  ///< what decode_polygons() reads; empty where there are no polygons
  std::uint64_t left_out = 0;         ///< polygons of which the triangles are kept, but not that they are one
};

/// `faces` are those of the mesh that was encoded, whose polygons these are; `first_corners` those of
/// EncodedConnectivity. A polygon is left out where its triangles are no fan around its first corner, each
/// next to the one before it.
EncodedPolygons encode_polygons(std::span<const Polygon> polygons, std::span<const Face> faces,
                                const PropertyMesh& mesh, std::span<const std::uint32_t> first_corners);

}  // namespace tvg
