#include "attributes/mesh_properties_encode.hpp"

#include "attributes/attributes_encode.hpp"
#include "attributes/parts_encode.hpp"

namespace tvg {

void encode_properties(const MeshProperties& properties, const ReferenceShape* shape, EncodedMesh& mesh) {
  const PropertyMesh coded{mesh.faces, mesh.coded.order, shape};
  mesh.parts = encode_parts(properties, coded, mesh.first_corners);
  mesh.attributes = encode_attributes(properties.attributes, coded, mesh.first_corners);
}

}  // namespace tvg
