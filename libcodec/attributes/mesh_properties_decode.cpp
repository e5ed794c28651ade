#include "attributes/attributes.hpp"
#include "attributes/mesh_properties.hpp"
#include "attributes/parts.hpp"
#include "attributes/polygons.hpp"

#include <utility>

namespace tvg {

// format-spec §4.3
Result<MeshProperties> decode_properties(const MeshLayout& layout, CodedMesh& coded,
                                         std::span<const Face> faces, const ReferenceShape* shape,
                                         const StreamLimits& limits, AnimatedAttributes& animated) {
  const PropertyMesh mesh{faces, coded.order, shape};
  MeshProperties properties;
  PropertyBudget budget(limits.property_bytes);
  if (!layout.parts.empty()) {
    if (Status status = decode_parts(layout.parts, mesh, budget, properties); !status.ok())
      return status.error();
  }
  if (!layout.attributes.empty()) {
    Result<std::vector<Attribute>> attributes =
        decode_attributes(layout.attributes, mesh, properties.parts.size(), budget, animated);
    if (!attributes) return attributes.error();
    properties.attributes = std::move(*attributes);
  }
  if (!layout.polygons.empty()) {
    Result<FaceFans> fans = decode_polygons(layout.polygons, mesh, budget);
    if (!fans) return fans.error();
    if (Status status = take_fans(std::move(*fans), coded.mesh.faces, properties); !status.ok())
      return status.error();
  }
  return properties;
}

}  // namespace tvg
