#include "decoder/exporters/polygon_faces.hpp"

#include <algorithm>

namespace tvg::cli {

namespace {

/// Whether the triangles lie around the first one's first corner, each beginning where the one before ends.
bool is_fan(std::span<const Face> triangles) {
  for (std::size_t i = 1; i < triangles.size(); ++i) {
    if (triangles[i][0] != triangles[0][0] || triangles[i][1] != triangles[i - 1][2]) return false;
  }
  return true;
}

}  // namespace

PolygonFaces::PolygonFaces(const Mesh& mesh, const MeshProperties& properties) {
  corners_.reserve(3 * mesh.faces.size());
  std::size_t triangle = 0;
  const auto add_triangles_to = [&](std::size_t end) {
    for (; triangle < end; ++triangle) add_triangle(triangle);
  };
  for (const Polygon& polygon : properties.polygons) {
    const std::size_t first = polygon.first_triangle;
    if (polygon.corners <= 3 || first < triangle || first >= mesh.faces.size() ||
        polygon.corners - 2 > mesh.faces.size() - first) {
      continue;
    }
    if (!is_fan(std::span(mesh.faces).subspan(first, polygon.corners - 2))) continue;
    add_triangles_to(first);
    add_fan(polygon);
    triangle = first + polygon.corners - 2;
  }
  add_triangles_to(mesh.faces.size());
}

void PolygonFaces::add_triangle(std::size_t triangle) {
  for (std::size_t corner = 0; corner < 3; ++corner) corners_.push_back(3 * triangle + corner);
  first_corner_.push_back(corners_.size());
}

void PolygonFaces::add_fan(const Polygon& polygon) {
  corners_.push_back(3 * polygon.first_triangle);
  corners_.push_back(3 * polygon.first_triangle + 1);
  for (std::size_t i = 0; i + 2 < polygon.corners; ++i)
    corners_.push_back(3 * (polygon.first_triangle + i) + 2);
  first_corner_.push_back(corners_.size());
  most_corners_ = std::max<std::size_t>(most_corners_, polygon.corners);
}

}  // namespace tvg::cli
