#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "connectivity/mesh_coder.hpp"
#include "connectivity/vertex_order.hpp"

#include <numeric>

namespace tvg {

// format-spec §4.3
Result<CodedMesh> decode_mesh(const MeshLayout& layout, std::uint32_t id) {
  // What the traversal may hold at once, its lists growing by doubling. Every vertex and face has its share
  // of a byte, so that this is in proportion to the payload.
  constexpr std::size_t kPerVertex = 48, kPerFace = 96, kModels = std::size_t{1} << 18;
  const std::uint64_t elements = std::uint64_t{layout.vertex_count} + layout.face_count;
  if (elements <= kMaxElementsPerByte * layout.connectivity.size() &&
      !can_allocate(kPerVertex * layout.vertex_count + kPerFace * layout.face_count + kModels)) {
    return out_of_memory();
  }
  Result<Connectivity> connectivity =
      decode_connectivity(layout.connectivity, layout.vertex_count, layout.face_count);
  if (!connectivity) return connectivity.error();

  CodedMesh coded;
  coded.id = id;
  coded.info = {layout.connectivity.size(), layout.order.size(), layout.shape.size(), layout.keeps_order};
  coded.gates = std::move(connectivity->gates);
  coded.mesh = {layout.vertex_count, std::move(connectivity->faces)};
  if (layout.keeps_order) {
    Result<std::vector<std::uint32_t>> order = decode_order(layout.order, coded.gates);
    if (!order) return order.error();
    coded.order = std::move(*order);
    for (Face& face : coded.mesh.faces) {
      for (std::uint32_t& corner : face) corner = coded.order[corner];
    }
  } else {
    coded.order.resize(layout.vertex_count);
    std::iota(coded.order.begin(), coded.order.end(), 0u);
  }
  return coded;
}

}  // namespace tvg
