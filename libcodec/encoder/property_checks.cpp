#include "encoder/property_checks.hpp"

#include "attributes/attribute_grid.hpp"
#include "attributes/property_size.hpp"
#include "base/errors.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace tvg {

namespace {

int settled_bits(const Attribute& attribute, const AttributeBits& bits) {
  if (attribute.bits != Attribute::kBitsOfKind) return attribute.bits;
  switch (attribute.kind) {
    case AttributeKind::kTexcoord:
      return bits.texcoord;
    case AttributeKind::kNormal:
      return bits.normal;
    case AttributeKind::kColour:
      return bits.colour;
    case AttributeKind::kGeneric:
      break;
  }
  return bits.generic;
}

Status check_kind(const Attribute& attribute, int bits, const std::string& who) {
  if (attribute.kind > AttributeKind::kGeneric || attribute.domain > AttributeDomain::kPart)
    return invalid_input(who + " is of a kind or of things that there are not");
  const bool normal = attribute.kind == AttributeKind::kNormal,
             colour = attribute.kind == AttributeKind::kColour;
  const std::uint32_t least = normal || colour ? 3 : 1, most = normal ? 3 : kMaxAttributeComponents;
  if (attribute.components < least || attribute.components > most) {
    return invalid_input(who + " has " + std::to_string(attribute.components) +
                         " components; normals have 3, colours 3 or 4, others 1 to 4");
  }
  const int fewest = normal ? kMinNormalBits : 1, finest = normal ? kMaxNormalBits : kMaxAttributeBits;
  if (bits != Attribute::kExact && (bits < fewest || bits > finest)) {
    return invalid_argument(who + " is to have " + std::to_string(bits) + " bits: 0 is exact, " +
                            (normal ? "2 to 16" : "1 to 24") + " are bits");
  }
  return {};
}

Status check_corners(const Attribute& attribute, const Mesh& mesh, const std::string& who) {
  const std::size_t expected = attribute.domain == AttributeDomain::kCorner ? 3 * mesh.faces.size() : 0;
  if (attribute.corners.size() == expected) return {};
  return invalid_input(who + " names the values of " + std::to_string(attribute.corners.size()) +
                       " corners, the mesh has " + std::to_string(3 * mesh.faces.size()));
}

/// The values of an attribute, in a frame where it is animated.
Status check_values(const Attribute& attribute, std::span<const float> values,
                    const MeshProperties& properties, const Mesh& mesh, const std::string& who) {
  const std::size_t count = values.size() / attribute.components;
  if (values.size() % attribute.components != 0)
    return invalid_input(who + " has a last value that is cut off");
  const auto beyond = std::find_if(attribute.corners.begin(), attribute.corners.end(),
                                   [&](std::uint32_t value) { return value >= count; });
  if (beyond != attribute.corners.end())
    return invalid_input(who + " has " + std::to_string(count) + " values, and a corner has value " +
                         std::to_string(*beyond));
  const bool of_vertices = attribute.domain == AttributeDomain::kVertex;
  const std::size_t expected = of_vertices ? mesh.vertex_count : properties.parts.size();
  if (attribute.domain != AttributeDomain::kCorner && count != expected) {
    return invalid_input(who + " has " + std::to_string(count) + " values for " + std::to_string(expected) +
                         (of_vertices ? " vertices" : " parts"));
  }
  if (!std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); }))
    return invalid_input(who + " has a value that is infinite or not a number");
  return {};
}

std::string named(const Attribute& attribute, std::size_t number) {
  return "attribute " + std::to_string(number) + " ('" + attribute.name + "')";
}

Status check_parts(const MeshProperties& properties, const Mesh& mesh) {
  const std::size_t expected = properties.parts.empty() ? 0 : mesh.faces.size();
  if (properties.face_parts.size() != expected) {
    return invalid_input("there are parts for " + std::to_string(properties.face_parts.size()) +
                         " faces of " + std::to_string(expected));
  }
  for (const std::uint32_t part : properties.face_parts) {
    if (part >= properties.parts.size())
      return invalid_input("a face is of part " + std::to_string(part) + " of " +
                           std::to_string(properties.parts.size()));
  }
  for (const Part& part : properties.parts) {
    if (!is_metadata_text(part.object) || !is_metadata_text(part.group) || !is_metadata_text(part.material))
      return invalid_input("a name of a part is no text in UTF-8");
  }
  return {};
}

Status check_polygons(const MeshProperties& properties, const Mesh& mesh) {
  std::size_t end = 0;
  for (const Polygon& polygon : properties.polygons) {
    if (polygon.corners < 4 || polygon.first_triangle < end || polygon.first_triangle > mesh.faces.size() ||
        polygon.corners - 2 > mesh.faces.size() - polygon.first_triangle)
      return invalid_input(
          "polygons must be of four corners or more, in order, and of triangles of the mesh");
    end = polygon.first_triangle + polygon.corners - 2;
  }
  return {};
}

}  // namespace

Status check_properties(const MeshProperties& properties, const Mesh& mesh, const AttributeBits& bits) {
  if (properties.attributes.size() > kMaxAttributes)
    return invalid_input("there are " + std::to_string(properties.attributes.size()) +
                         " attributes, a stream can hold 64");
  if (Status status = check_parts(properties, mesh); !status.ok()) return status;
  if (Status status = check_polygons(properties, mesh); !status.ok()) return status;
  for (std::size_t i = 0; i < properties.attributes.size(); ++i) {
    const Attribute& attribute = properties.attributes[i];
    if (!is_metadata_text(attribute.name))
      return invalid_input("the name of attribute " + std::to_string(i) + " is no text in UTF-8");
    const std::string who = named(attribute, i);
    if (Status status = check_kind(attribute, settled_bits(attribute, bits), who); !status.ok())
      return status;
    if (Status status = check_corners(attribute, mesh, who); !status.ok()) return status;
    if (attribute.animated) continue;
    if (Status status = check_values(attribute, attribute.values, properties, mesh, who); !status.ok())
      return status;
  }
  if (property_bytes_of(properties, mesh) > 0xFFFFFFFF)
    return invalid_input("what the mesh has beside its connectivity takes more than 4 GiB");
  return {};
}

Status check_animated(const MeshProperties& properties, const Mesh& mesh,
                      std::span<const std::span<const float>> values, std::uint64_t frame) {
  for (std::size_t i = 0; i < properties.attributes.size(); ++i) {
    const Attribute& attribute = properties.attributes[i];
    if (!attribute.animated) continue;
    if (i >= values.size())
      return at_frame(frame, invalid_argument(named(attribute, i) + " is animated, and has no values here"));
    Status status = check_values(attribute, values[i], properties, mesh, named(attribute, i));
    if (!status.ok()) return at_frame(frame, status.error());
  }
  return {};
}

Status check_property_bounds(const MeshProperties& properties, const Mesh& mesh, std::uint64_t property_bytes,
                             std::uint64_t frame_bytes) {
  const std::uint64_t all = property_bytes_of(properties, mesh);
  const std::uint64_t of_frame = animated_frame_bytes_of(properties, mesh);
  if (all > property_bytes) {
    return Error{ErrorCode::kLimitExceeded, "what the mesh has beside its connectivity takes " +
                                                std::to_string(all) + " bytes, the head declares " +
                                                std::to_string(property_bytes)};
  }
  if (of_frame > frame_bytes) {
    return Error{ErrorCode::kLimitExceeded,
                 "the values of animated attributes may take " + std::to_string(of_frame) +
                     " bytes of a frame, the head allows for " + std::to_string(frame_bytes)};
  }
  return {};
}

std::vector<std::vector<float>> animated_of(const MeshProperties& properties,
                                            std::span<const std::span<const float>> values) {
  std::vector<std::vector<float>> animated;
  for (std::size_t i = 0; i < properties.attributes.size(); ++i) {
    if (properties.attributes[i].animated) animated.emplace_back(values[i].begin(), values[i].end());
  }
  return animated;
}

MeshProperties with_settled_bits(MeshProperties properties, const AttributeBits& bits) {
  for (Attribute& attribute : properties.attributes) {
    attribute.bits = settled_bits(attribute, bits);
    if (attribute.animated) attribute.values.clear();
  }
  return properties;
}

std::uint64_t animated_frame_bytes_of(const MeshProperties& properties, const Mesh& mesh) {
  return animated_frame_bytes(properties, mesh.vertex_count, mesh.faces.size());
}

std::uint64_t property_bytes_of(const MeshProperties& properties, const Mesh& mesh) {
  return property_bytes(properties, mesh.vertex_count, mesh.faces.size());
}

}  // namespace tvg
