#include "geometry/half_edges_encode.hpp"

#include <algorithm>

namespace tvg {
namespace {

struct HalfEdge {
  std::uint32_t low, high;  ///< its ends, ordered by index
  std::uint32_t id;
  bool ascending;
};

std::uint32_t corner(const Mesh& mesh, std::uint32_t half_edge, std::uint32_t step) {
  return mesh.faces[half_edge / 3][(half_edge % 3 + step) % 3];
}

std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh) {
  std::vector<HalfEdge> result;
  result.reserve(3 * mesh.faces.size());
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    const Face& f = mesh.faces[face];
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t from = f[c], to = f[(c + 1) % 3];
      result.push_back({std::min(from, to), std::max(from, to), 3 * face + c, from < to});
    }
  }
  std::sort(result.begin(), result.end(), [](const HalfEdge& x, const HalfEdge& y) {
    if (x.low != y.low) return x.low < y.low;
    if (x.high != y.high) return x.high < y.high;
    return x.id < y.id;
  });
  return result;
}

}  // namespace

std::vector<std::uint32_t> pair_half_edges(const Mesh& mesh) {
  std::vector<std::uint32_t> partner(3 * mesh.faces.size(), kNoHalfEdge);
  const std::vector<HalfEdge> sorted = sorted_half_edges(mesh);
  std::vector<std::uint32_t> up, down;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    up.clear();
    down.clear();
    for (; end < sorted.size() && sorted[end].low == sorted[begin].low &&
           sorted[end].high == sorted[begin].high;
         ++end) {
      (sorted[end].ascending ? up : down).push_back(sorted[end].id);
    }
    // A sheet and its back side, both in the mesh, share every edge: the first choice is never a face's own
    // back.
    const std::size_t count = std::min(up.size(), down.size());
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i; j < std::min(down.size(), i + 4); ++j) {
        if (corner(mesh, up[i], 2) != corner(mesh, down[j], 2)) {
          std::swap(down[i], down[j]);
          break;
        }
      }
      partner[up[i]] = down[i];
      partner[down[i]] = up[i];
    }
  }
  return partner;
}

}  // namespace tvg
