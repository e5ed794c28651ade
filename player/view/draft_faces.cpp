#include "player/view/draft_faces.hpp"

#include <cstdint>

#include <tvg/geometry.hpp>

namespace tvg::player {

std::vector<Face> draft_faces(const Mesh& mesh) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  const OneRings rings(mesh);
  std::vector<std::uint32_t> stays(mesh.vertex_count, kNone);  // the vertex that stands for each
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    if (stays[v] != kNone) continue;
    stays[v] = v;
    for (const std::uint32_t face : rings.faces_at(v)) {
      for (const std::uint32_t neighbour : mesh.faces[face]) {
        if (stays[neighbour] == kNone) stays[neighbour] = v;
      }
    }
  }
  std::vector<Face> faces;
  for (const auto& [a, b, c] : mesh.faces) {
    const Face face = {stays[a], stays[b], stays[c]};
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) faces.push_back(face);
  }
  return faces;
}

}  // namespace tvg::player
