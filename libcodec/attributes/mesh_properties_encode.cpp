#include "attributes/mesh_properties_encode.hpp"

#include "attributes/attributes_encode.hpp"
#include "attributes/parts_encode.hpp"
#include "attributes/polygons_encode.hpp"

#include <utility>

namespace tvg {

void encode_properties(const MeshProperties& properties, const ReferenceShape* shape, EncodedMesh& mesh,
                       AnimatedAttributes& animated) {
  const PropertyMesh coded{mesh.faces, mesh.coded.order, shape};
  mesh.parts = encode_parts(properties, coded, mesh.first_corners);
  mesh.attributes =
      encode_attributes(properties.attributes, coded, mesh.first_corners, properties.parts.size(), animated);
  EncodedPolygons polygons =
      encode_polygons(properties.polygons, mesh.coded.mesh.faces, coded, mesh.first_corners);
  mesh.polygons = std::move(polygons.section);
  mesh.polygons_left_out = polygons.left_out;
}

}  // namespace tvg
