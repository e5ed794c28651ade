#include "decoder/exporters/mesh_frame.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace tvg::cli {

std::span<const float> values_of(const MeshFrame& frame, std::size_t attribute) {
  const Attribute& described = frame.properties.attributes[attribute];
  if (!described.animated) return described.values;
  return attribute < frame.animated.size() ? frame.animated[attribute] : std::span<const float>();
}

KnownAttributes known_attributes(const MeshProperties& properties) {
  KnownAttributes known;
  const auto take = [](std::optional<std::size_t>& place, std::size_t index) {
    if (place) return false;
    place = index;
    return true;
  };
  for (std::size_t i = 0; i < properties.attributes.size(); ++i) {
    const Attribute& attribute = properties.attributes[i];
    bool taken = false;
    if (attribute.domain != AttributeDomain::kPart) {
      if (attribute.kind == AttributeKind::kTexcoord && attribute.components >= 2)
        taken = take(known.texcoord, i);
      if (attribute.kind == AttributeKind::kNormal && attribute.components == 3)
        taken = take(known.normal, i);
      if (attribute.kind == AttributeKind::kColour && attribute.components >= 3)
        taken = take(known.colour, i);
    }
    if (!taken) known.others.push_back(i);
  }
  return known;
}

std::optional<std::vector<std::uint32_t>> vertex_values(const Mesh& mesh, const Attribute& attribute) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> values(mesh.vertex_count, kNone);
  switch (attribute.domain) {
    case AttributeDomain::kVertex:
      for (std::uint32_t vertex = 0; vertex < mesh.vertex_count; ++vertex) values[vertex] = vertex;
      return values;
    case AttributeDomain::kCorner:
      for (std::size_t corner = 0; corner < attribute.corners.size(); ++corner) {
        std::uint32_t& value = values[mesh.faces[corner / 3][corner % 3]];
        if (value != kNone && value != attribute.corners[corner]) return std::nullopt;
        value = attribute.corners[corner];
      }
      std::replace(values.begin(), values.end(), kNone, std::uint32_t{0});
      return values;
    case AttributeDomain::kPart:
      break;
  }
  return std::nullopt;
}

bool are_bytes(std::span<const float> values) {
  constexpr float kTolerance = 1e-3F;  // of a 255th: what arithmetic in float32 may have added
  return std::all_of(values.begin(), values.end(), [](float value) {
    const float scaled = 255 * value;
    return scaled > -kTolerance && scaled < 255 + kTolerance &&
           std::abs(scaled - std::round(scaled)) < kTolerance;
  });
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); }, ' ');
  return text;
}

}  // namespace tvg::cli
