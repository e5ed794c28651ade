#include "simplify/cut_mesh.hpp"

#include "geometry/half_edges_encode.hpp"

#include <numeric>

namespace tvg {
namespace {

/// Corners that belong together, by the smallest of them.
class CornerSets {
 public:
  explicit CornerSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::uint32_t next_corner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

}  // namespace

CutMesh cut_mesh(const Mesh& mesh) {
  CutMesh cut;
  Mesh sound{mesh.vertex_count, {}};
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    sound.faces.push_back(face);
    cut.face_of.push_back(f);
  }
  cut.partner = pair_half_edges(sound);

  const auto corner_count = static_cast<std::uint32_t>(cut.partner.size());
  CornerSets fans(corner_count);
  for (std::uint32_t h = 0; h < corner_count; ++h) {
    if (cut.partner[h] != kNoHalfEdge) fans.join(h, next_corner(cut.partner[h]));
  }
  cut.origin.resize(mesh.vertex_count);
  std::iota(cut.origin.begin(), cut.origin.end(), 0u);
  cut.locked.assign(mesh.vertex_count, 0);
  cut.used.assign(mesh.vertex_count, 0);
  cut.copies_of.assign(mesh.vertex_count, kNoHalfEdge);
  cut.faces.resize(sound.faces.size());
  std::vector<std::uint32_t> vertex_of_fan(corner_count, kNoHalfEdge);
  for (std::uint32_t corner = 0; corner < corner_count; ++corner) {
    const std::uint32_t original = sound.faces[corner / 3][corner % 3], fan = fans.find(corner);
    if (vertex_of_fan[fan] == kNoHalfEdge && cut.used[original] == 0) {
      cut.used[original] = 1;
      vertex_of_fan[fan] = original;
    } else if (vertex_of_fan[fan] == kNoHalfEdge) {
      vertex_of_fan[fan] = static_cast<std::uint32_t>(cut.origin.size());
      if (cut.copies_of[original] == kNoHalfEdge) {
        cut.copies_of[original] = static_cast<std::uint32_t>(cut.copies.size());
        cut.copies.push_back({original});
        cut.locked[original] = 1;
      }
      cut.copies[cut.copies_of[original]].push_back(vertex_of_fan[fan]);
      cut.origin.push_back(original);
      cut.locked.push_back(1);
      cut.used.push_back(1);
    }
    cut.faces[corner / 3][corner % 3] = vertex_of_fan[fan];
  }
  return cut;
}

}  // namespace tvg
