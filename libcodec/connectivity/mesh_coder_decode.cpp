#include "base/checksum.hpp"
#include "connectivity/mesh_coder.hpp"
#include "connectivity/vertex_order.hpp"
#include "container/layout.hpp"

#include <numeric>

namespace tvg {

// format-spec §4.3
Result<CodedMesh> decode_mesh(Bytes payload, const StreamLimits& limits) {
  Result<MeshLayout> layout = read_mesh(payload);
  if (!layout) return layout.error();
  if (layout->vertex_count > limits.vertices || layout->face_count > limits.faces) {
    return Error{
        ErrorCode::kLimitExceeded, "the mesh is larger than the stream's head declares", {}, {}, "§4.1"};
  }
  Result<Connectivity> connectivity =
      decode_connectivity(layout->connectivity, layout->vertex_count, layout->face_count);
  if (!connectivity) return connectivity.error();

  CodedMesh coded;
  coded.payload_checksum = checksum(payload);
  coded.info = {layout->connectivity.size(), layout->order.size(), layout->keeps_order};
  coded.gates = std::move(connectivity->gates);
  coded.mesh = {layout->vertex_count, std::move(connectivity->faces)};
  if (layout->keeps_order) {
    Result<std::vector<std::uint32_t>> order = decode_order(layout->order, coded.gates);
    if (!order) return order.error();
    coded.order = std::move(*order);
    for (Face& face : coded.mesh.faces) {
      for (std::uint32_t& corner : face) corner = coded.order[corner];
    }
  } else {
    coded.order.resize(layout->vertex_count);
    std::iota(coded.order.begin(), coded.order.end(), 0u);
  }
  return coded;
}

}  // namespace tvg
