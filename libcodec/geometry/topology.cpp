#include "geometry/topology.hpp"

#include <array>
#include <utility>

namespace tvg {
namespace {

/// The other two corners of a face at a vertex, in the face's sense.
using Spoke = std::array<std::uint32_t, 2>;

/// Whether one walk from face to face meets every face once and ends at its start. `spokes` are reordered.
bool is_closed_fan(std::vector<Spoke>& spokes) {
  if (spokes.size() < 3) return false;
  const std::uint32_t start = spokes[0][0];
  std::uint32_t at = start;
  std::size_t met = 0;  // those met stand before it
  do {
    std::size_t next = met, candidates = 0;
    for (std::size_t k = met; k < spokes.size(); ++k) {
      if (spokes[k][0] == at) next = k, ++candidates;
    }
    if (candidates != 1) return false;
    std::swap(spokes[met], spokes[next]);
    at = spokes[met++][1];
  } while (at != start);
  return met == spokes.size();
}

}  // namespace

std::vector<std::uint8_t> closed_fans(const Mesh& mesh, const OneRings& rings) {
  std::vector<std::uint8_t> closed(mesh.vertex_count, 0);
  std::vector<Spoke> spokes;
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    spokes.clear();
    for (const std::uint32_t f : rings.faces_at(v)) {
      const Face& face = mesh.faces[f];
      if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
      const std::size_t k = face[1] == v ? 1 : face[2] == v ? 2 : 0;
      spokes.push_back({face[(k + 1) % 3], face[(k + 2) % 3]});
    }
    closed[v] = is_closed_fan(spokes) ? 1 : 0;
  }
  return closed;
}

const OneRings& Topology::rings() const {
  std::call_once(rings_once_, [this] { rings_.emplace(mesh_); });
  return *rings_;
}

const std::vector<std::uint8_t>& Topology::closed_fans() const {
  std::call_once(fans_once_, [this] { fans_ = tvg::closed_fans(mesh_, rings()); });
  return fans_;
}

}  // namespace tvg
