#include "geometry/property_fault.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace tvg {

namespace {

/// What is wrong with an attribute of this mesh, or null.
const char* fault_of(const Attribute& attribute, const Mesh& mesh, std::size_t parts) {
  if (attribute.components < 1 || attribute.components > kMaxAttributeComponents)
    return "an attribute has one to four components";
  if (!attribute.animated && attribute.values.size() % attribute.components != 0)
    return "an attribute's values do not divide into its components";
  const std::size_t values = attribute.value_count();
  switch (attribute.domain) {
    case AttributeDomain::kVertex:
      return attribute.animated || values == mesh.vertex_count
                 ? nullptr
                 : "an attribute of vertices has a value for each vertex";
    case AttributeDomain::kPart:
      return attribute.animated || values == parts ? nullptr
                                                   : "an attribute of parts has a value for each part";
    case AttributeDomain::kCorner:
      break;
    default:
      return "there is no such domain of attributes";
  }
  if (attribute.corners.size() != 3 * mesh.faces.size())
    return "an attribute of corners says for every corner which value it has";
  const auto within = [&](std::uint32_t value) { return value < (attribute.animated ? UINT32_MAX : values); };
  return std::all_of(attribute.corners.begin(), attribute.corners.end(), within)
             ? nullptr
             : "a corner has a value that the attribute does not have";
}

}  // namespace

const char* property_fault(const Mesh& mesh, const MeshProperties& properties) {
  if (mesh.faces.size() > kMaxFaceCount) return "a mesh has at most 2^30 faces";
  for (const Face& face : mesh.faces) {
    for (const std::uint32_t vertex : face) {
      if (vertex >= mesh.vertex_count) return "a face has a vertex that the mesh does not have";
    }
  }
  const std::size_t parts = properties.parts.size();
  if (properties.face_parts.size() != (parts > 0 ? mesh.faces.size() : 0))
    return "where there are parts every face is of one";
  for (const std::uint32_t part : properties.face_parts) {
    if (part >= parts) return "a face is of a part that the mesh does not have";
  }
  for (const Attribute& attribute : properties.attributes) {
    if (const char* const fault = fault_of(attribute, mesh, parts)) return fault;
  }
  return nullptr;
}

}  // namespace tvg
