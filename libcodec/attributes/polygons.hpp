#pragma once
#include "attributes/property_mesh.hpp"
#include "attributes/property_size.hpp"
#include "base/byte_io.hpp"

#include <cstdint>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// The faces of a mesh in an order in which those of a polygon stand together, a fan around its first corner.
struct FaceFans {
  /// [face]: the corner that stands first, 3 * face + corner in the order of the traversal.
  std::vector<std::uint32_t> first_corners;
  std::vector<Polygon> polygons;
};

/// Decodes the polygons of a mesh from all of their section (format-spec §5.9). kMalformed, kLimitExceeded,
/// kOutOfMemory.
Result<FaceFans> decode_polygons(Bytes section, const PropertyMesh& mesh, PropertyBudget& budget);

/// Puts faces, which are in the order of the traversal, in that of the fans, and what properties say of faces
/// and corners, which takes over the polygons. kOutOfMemory.
Status take_fans(FaceFans fans, std::vector<Face>& faces, MeshProperties& properties);

}  // namespace tvg
