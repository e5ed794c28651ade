#include "streams/surveyed_properties.hpp"

#include "attributes/mesh_properties.hpp"
#include "connectivity/mesh_coder.hpp"
#include "planes/reference_shape.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace tvg {

namespace {

Result<MeshProperties> properties_of(const MeshLayout& layout, const StreamLimits& limits) {
  Result<CodedMesh> coded = decode_mesh(layout, 0);
  if (!coded) return coded.error();
  const Result<std::vector<Face>> faces = faces_by_traversal(*coded);
  if (!faces) return faces.error();
  std::optional<ReferenceShape> shape;
  if (!layout.shape.empty()) {
    Result<ReferenceShape> decoded = decode_reference_shape(layout.shape, *faces, layout.vertex_count);
    if (!decoded) return decoded.error();
    shape = std::move(*decoded);
  }
  AnimatedAttributes animated;
  return decode_properties(layout, *coded, *faces, shape ? &*shape : nullptr, limits, animated);
}

}  // namespace

Status survey_properties(const MeshLayout& layout, const StreamLimits& limits, SurveyedMesh& surveyed) {
  if (layout.parts.empty() && layout.attributes.empty() && layout.polygons.empty()) return {};
  Result<MeshProperties> properties = properties_of(layout, limits);
  if (!properties) return properties.error();
  for (Attribute& attribute : properties->attributes) {
    const std::size_t values = attribute.value_count();
    surveyed.attributes.push_back({std::move(attribute.name), attribute.kind, attribute.domain,
                                   attribute.components, attribute.bits, attribute.animated, values});
  }
  for (Part& part : properties->parts) surveyed.face_parts.push_back({std::move(part), 0});
  for (const std::uint32_t part : properties->face_parts) ++surveyed.face_parts[part].faces;
  surveyed.polygons = properties->polygons.size();
  return {};
}

}  // namespace tvg
