#include "simplify/removal_history.hpp"

#include <algorithm>
#include <utility>

namespace tvg {

RemovalHistory::RemovalHistory(const HalfEdgeMesh& mesh, std::vector<Removal> removals)
    : vertex_count_(mesh.cut().copies_of.size()),
      faces_(mesh.cut().faces),
      face_of_(mesh.cut().face_of),
      removals_(std::move(removals)),
      at_vertices_(vertex_count_) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.has_face(f)) base_.push_back({f, mesh.face(f), {1, 0, 0}});
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      SurfacePlace place{face_of_[f], {0, 0, 0}};
      place.weights[c] = 1;
      at_vertices_[mesh.origin(faces_[f][c])] = place;
    }
  }
}

std::vector<SurfacePlace> RemovalHistory::on_original(std::vector<FacePoint> points) const {
  std::vector<std::vector<std::uint32_t>> inside(faces_.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) inside[points[i].face].push_back(i);
  std::vector<std::uint32_t> moving;
  for (std::size_t r = removals_.size(); r-- > 0;) {
    const Removal& removal = removals_[r];
    moving.clear();
    for (std::size_t t = 0; t < removal.triangles.size(); ++t) {
      std::vector<std::uint32_t>& here = inside[removal.faces[t]];
      moving.insert(moving.end(), here.begin(), here.end());
      here.clear();
    }
    for (const std::uint32_t i : moving) {
      carry_back(removal, points[i]);
      inside[points[i].face].push_back(i);
    }
  }
  std::vector<SurfacePlace> places;
  places.reserve(points.size());
  for (const FacePoint& point : points) {
    SurfacePlace place{face_of_[point.face], {0, 0, 0}};
    const Face& face = faces_[point.face];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto corner = std::find(face.begin(), face.end(), point.corners[c]);
      place.weights[static_cast<std::size_t>(corner - face.begin())] = point.weights[c];
    }
    places.push_back(place);
  }
  return places;
}

}  // namespace tvg
