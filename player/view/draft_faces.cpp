#include "player/view/draft_faces.hpp"

#include <cstdint>
#include <numeric>

namespace tvg::cli {

std::vector<Face> draft_faces(const Mesh& mesh) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  // faces_at[begin[v]] to faces_at[begin[v + 1]]: the faces around v.
  std::vector<std::size_t> begin(mesh.vertex_count + std::size_t{1}, 0);
  for (const Face& face : mesh.faces) {
    for (const std::uint32_t corner : face) ++begin[corner + std::size_t{1}];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> faces_at(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::uint32_t corner : mesh.faces[f]) faces_at[next[corner]++] = f;
  }

  std::vector<std::uint32_t> stays(mesh.vertex_count, kNone);  // the vertex that stands for each
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    if (stays[v] != kNone) continue;
    stays[v] = v;
    for (std::size_t i = begin[v]; i < begin[v + std::size_t{1}]; ++i) {
      for (const std::uint32_t neighbour : mesh.faces[faces_at[i]]) {
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

}  // namespace tvg::cli
