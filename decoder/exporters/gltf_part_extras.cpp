#include "decoder/exporters/gltf_part_extras.hpp"

#include <algorithm>
#include <vector>

namespace tvg::cli {

using nlohmann::json;

namespace {

/// Whether the part has all triangles of a polygon, one after the other from `at` on.
bool has_whole(const Polygon& polygon, std::span<const std::uint32_t> faces, std::size_t at) {
  const std::size_t triangles = polygon.corners - 2;
  if (faces.size() - at < triangles) return false;
  for (std::size_t i = 0; i < triangles; ++i) {
    if (faces[at + i] != polygon.first_triangle + i) return false;
  }
  return true;
}

/// Runs of faces with as many corners.
json polygon_runs(const std::vector<Polygon>& polygons, std::span<const std::uint32_t> faces) {
  std::vector<std::uint64_t> runs;
  const auto add = [&runs](std::uint32_t corners) {
    if (runs.empty() || runs.back() != corners) runs.insert(runs.end(), {0, corners});
    ++runs[runs.size() - 2];
  };
  bool has_polygons = false;
  for (std::size_t at = 0; at < faces.size();) {
    const auto found = std::lower_bound(
        polygons.begin(), polygons.end(), faces[at],
        [](const Polygon& polygon, std::uint32_t face) { return polygon.first_triangle < face; });
    const bool begins = found != polygons.end() && found->first_triangle == faces[at] && found->corners > 3 &&
                        has_whole(*found, faces, at);
    add(begins ? found->corners : 3);
    at += begins ? found->corners - 2 : 1;
    has_polygons = has_polygons || begins;
  }
  return has_polygons ? json(runs) : json();
}

}  // namespace

json gltf_part_extras(const MeshProperties& properties, std::size_t part,
                      std::span<const std::uint32_t> faces) {
  json extras;
  if (part < properties.parts.size()) {
    const Part& described = properties.parts[part];
    if (!described.object.empty()) extras["object"] = described.object;
    if (!described.group.empty()) extras["group"] = described.group;
  }
  for (const Attribute& attribute : properties.attributes) {
    if (attribute.domain != AttributeDomain::kPart || part >= attribute.value_count()) continue;
    json& values = extras["values"][attribute.name];
    for (std::size_t i = 0; i < attribute.components; ++i)
      values.push_back(attribute.values[part * attribute.components + i]);
  }
  if (json runs = polygon_runs(properties.polygons, faces); !runs.is_null())
    extras["polygons"] = std::move(runs);
  return extras;
}

}  // namespace tvg::cli
