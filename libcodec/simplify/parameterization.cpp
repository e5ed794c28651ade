#include "simplify/parameterization.hpp"

#include <algorithm>

namespace tvg {
namespace {

std::vector<std::array<PlanePoint, 3>> planes_of_triangles(const Removal& removal) {
  std::vector<std::array<PlanePoint, 3>> result;
  for (const RingTriangle& t : removal.triangles) {
    result.push_back({removal.plane[t[0]], removal.plane[t[1]], removal.plane[t[2]]});
  }
  return result;
}

PlanePoint in_plane(const Removal& removal, const FacePoint& point) {
  PlanePoint result{0, 0};
  for (std::size_t c = 0; c < 3; ++c) {
    if (point.corners[c] == removal.center) continue;
    const auto at = std::find(removal.vertices.begin(), removal.vertices.end(), point.corners[c]);
    const PlanePoint& corner = removal.plane[static_cast<std::size_t>(at - removal.vertices.begin())];
    result[0] += point.weights[c] * corner[0];
    result[1] += point.weights[c] * corner[1];
  }
  return result;
}

}  // namespace

void carry_back(const Removal& removal, FacePoint& point) {
  std::vector<std::array<PlanePoint, 3>> star;
  const std::size_t n = removal.vertices.size();
  for (std::size_t i = 0; i < removal.faces.size(); ++i) {
    star.push_back({PlanePoint{0, 0}, removal.plane[i], removal.plane[(i + 1) % n]});
  }
  const PlaneLocation location = locate(in_plane(removal, point), star);
  const std::size_t i = location.triangle;
  point = {removal.faces[i],
           {removal.center, removal.vertices[i], removal.vertices[(i + 1) % n]},
           location.weights};
}

Parameterization::Parameterization(const HalfEdgeMesh& mesh)
    : places_(mesh.vertex_count()), inside_(mesh.face_count()) {}

void Parameterization::replace(const Removal& removal) {
  moving_.clear();
  for (const std::uint32_t face : removal.faces) {
    moving_.insert(moving_.end(), inside_[face].begin(), inside_[face].end());
    inside_[face].clear();
  }
  FacePoint& center = places_[removal.center];
  center.corners = {removal.center, removal.center, removal.center};
  center.weights = {1, 0, 0};
  moving_.push_back(removal.center);
  const std::vector<std::array<PlanePoint, 3>> planes = planes_of_triangles(removal);
  for (const std::uint32_t vertex : moving_) {
    const PlaneLocation location = locate(in_plane(removal, places_[vertex]), planes);
    const RingTriangle& t = removal.triangles[location.triangle];
    const std::uint32_t face = removal.faces[location.triangle];
    places_[vertex] = {
        face, {removal.vertices[t[0]], removal.vertices[t[1]], removal.vertices[t[2]]}, location.weights};
    inside_[face].push_back(vertex);
  }
}

}  // namespace tvg
