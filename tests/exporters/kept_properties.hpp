#pragma once
#include "tests/exporters/whole_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

// What of a mesh with everything is still there after it went through files.
namespace tvg::cli::testing {

inline constexpr int kFrameCount = 3;

/// All that was read.
struct Seen {
  Mesh mesh;
  MeshProperties properties;
  Metadata metadata;
  std::vector<NamedData> data;
  std::vector<FramePositions> frames;
};

inline WholeMesh whole_mesh() {
  WholeMesh whole;
  whole.add_normals();
  whole.add_colours();
  // No order in which faces name vertices.
  for (Face& face : whole.mesh.faces) {
    for (std::uint32_t& vertex : face) vertex = vertex == 0 ? 5 : vertex == 5 ? 0 : vertex;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::swap(whole.positions[axis], whole.positions[15 + axis]);
    for (Attribute& attribute : whole.properties.attributes) {
      if (attribute.domain == AttributeDomain::kVertex)
        std::swap(attribute.values[axis], attribute.values[15 + axis]);
    }
  }
  return whole;
}

inline bool is_near(double a, double b) {
  return std::abs(a - b) <= 2e-3;
}

/// [vertex of the whole mesh]: the one that is where it is in every frame.
inline std::optional<std::vector<std::uint32_t>> places_of(const Seen& seen) {
  const WholeMesh whole = whole_mesh();
  std::vector<std::uint32_t> places;
  if (seen.frames.size() != kFrameCount) return std::nullopt;
  for (std::size_t vertex = 0; vertex < whole.mesh.vertex_count; ++vertex) {
    std::uint32_t place = 0;
    const auto is_there = [&](std::uint32_t candidate) {
      for (int frame = 0; frame < kFrameCount; ++frame) {
        const FramePositions wanted = whole.frame(frame);
        const FramePositions& found = seen.frames[static_cast<std::size_t>(frame)];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (!is_near(wanted[3 * vertex + axis], found[3 * std::size_t{candidate} + axis])) return false;
        }
      }
      return true;
    };
    while (place < seen.mesh.vertex_count && !is_there(place)) ++place;
    if (place == seen.mesh.vertex_count) return std::nullopt;
    places.push_back(place);
  }
  return places;
}

inline const Attribute* find(const MeshProperties& properties, AttributeKind kind) {
  for (const Attribute& attribute : properties.attributes) {
    if (attribute.kind == kind && !attribute.values.empty()) return &attribute;
  }
  return nullptr;
}

/// Faces by the whole mesh's vertices, each beginning with its smallest, with where it is among its like.
inline std::map<std::array<std::uint32_t, 3>, std::pair<std::size_t, std::size_t>> faces_of(
    const Mesh& mesh, const std::vector<std::uint32_t>& places) {
  std::map<std::array<std::uint32_t, 3>, std::pair<std::size_t, std::size_t>> faces;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto place = std::ranges::find(places, mesh.faces[face][i]);
      if (place == places.end()) return {};
      corners[i] = static_cast<std::uint32_t>(place - places.begin());
    }
    const std::size_t first = static_cast<std::size_t>(std::ranges::min_element(corners) - corners.begin());
    std::ranges::rotate(corners, corners.begin() + static_cast<std::ptrdiff_t>(first));
    faces.emplace(corners, std::pair(face, first));
  }
  return faces;
}

/// The value that a corner has.
inline std::span<const float> value_at(const Mesh& mesh, const Attribute& attribute, std::size_t face,
                                       std::size_t corner) {
  const std::size_t value = attribute.domain == AttributeDomain::kCorner
                                ? attribute.corners[3 * face + corner]
                                : mesh.faces[face][corner];
  return std::span(attribute.values).subspan(value * attribute.components, attribute.components);
}

inline bool keeps_attribute(const Seen& seen, AttributeKind kind) {
  const WholeMesh whole = whole_mesh();
  const auto places = places_of(seen);
  const Attribute* const found = find(seen.properties, kind);
  if (!places || found == nullptr) return false;
  const Attribute& wanted = *find(whole.properties, kind);
  const auto before = faces_of(whole.mesh, {0, 1, 2, 3, 4, 5});
  const auto after = faces_of(seen.mesh, *places);
  for (const auto& [corners, at] : before) {
    const auto same = after.find(corners);
    if (same == after.end()) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = value_at(whole.mesh, wanted, at.first, (at.second + i) % 3);
      const auto b = value_at(seen.mesh, *found, same->second.first, (same->second.second + i) % 3);
      if (!std::ranges::equal(a, b.first(a.size()), is_near)) return false;
    }
  }
  return true;
}

inline bool keeps_parts(const Seen& seen) {
  const WholeMesh whole = whole_mesh();
  const auto places = places_of(seen);
  if (!places || seen.properties.parts.empty()) return false;
  const auto after = faces_of(seen.mesh, *places);
  for (const auto& [corners, at] : faces_of(whole.mesh, {0, 1, 2, 3, 4, 5})) {
    const auto same = after.find(corners);
    if (same == after.end()) return false;
    const std::uint32_t part = seen.properties.face_parts[same->second.first];
    if (seen.properties.parts[part] != whole.properties.parts[whole.properties.face_parts[at.first]])
      return false;
  }
  return true;
}

inline bool keeps_materials(const Seen& seen) {
  for (const NamedData& data : seen.data) {
    if (data.name != "materials") continue;
    const auto json = nlohmann::json::parse(data.bytes, nullptr, false);
    return json["materials"].size() == 2 && json["materials"][0]["name"] == "red" &&
           json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] == nlohmann::json({1, 0, 0, 0.5});
  }
  return false;
}

inline bool has_data(const Seen& seen, const std::string& name) {
  return std::ranges::any_of(seen.data, [&](const NamedData& data) { return data.name == name; });
}

inline bool keeps_order(const Seen& seen) {
  return seen.mesh.faces == whole_mesh().mesh.faces &&
         places_of(seen) == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5};
}

inline bool keeps(const Seen& seen, const std::string& property) {
  if (property == "positions") return places_of(seen).has_value();
  if (property == "order") return keeps_order(seen);
  if (property == "polygons") return seen.properties.polygons == whole_mesh().properties.polygons;
  if (property == "texcoords") return keeps_attribute(seen, AttributeKind::kTexcoord);
  if (property == "normals") return keeps_attribute(seen, AttributeKind::kNormal);
  if (property == "colours") return keeps_attribute(seen, AttributeKind::kColour);
  if (property == "materials") return keeps_materials(seen);
  if (property == "parts") return keeps_parts(seen);
  if (property == "skeleton") return has_data(seen, "skeleton");
  const auto fps = seen.metadata.find("fps");
  return fps != seen.metadata.end() && fps->second == "25";
}

}  // namespace tvg::cli::testing
