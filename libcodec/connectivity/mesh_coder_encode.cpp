#include "connectivity/mesh_coder_encode.hpp"

#include "base/checksum.hpp"
#include "connectivity/connectivity_encode.hpp"
#include "connectivity/vertex_order_encode.hpp"
#include "container/mesh_payload.hpp"

namespace tvg {

EncodedMesh encode_mesh(const Mesh& mesh, bool keep_order) {
  EncodedConnectivity encoded = encode_connectivity(mesh);
  EncodedMesh result;
  if (keep_order) result.order = encode_order(encoded.order, encoded.connectivity.gates);
  result.coded.mesh = mesh;
  result.coded.gates = std::move(encoded.connectivity.gates);
  result.coded.order = std::move(encoded.order);
  result.coded.info = {encoded.bytes.size(), result.order.size(), 0, keep_order};
  result.connectivity = std::move(encoded.bytes);
  return result;
}

std::vector<std::uint8_t> mesh_payload(EncodedMesh& mesh, std::span<const std::uint8_t> shape) {
  mesh.coded.info.shape_bytes = shape.size();
  std::vector<std::uint8_t> payload =
      write_mesh({mesh.coded.mesh.vertex_count, static_cast<std::uint32_t>(mesh.coded.mesh.faces.size()),
                  mesh.coded.info.keeps_vertex_order, mesh.connectivity, mesh.order, shape});
  mesh.coded.id = checksum(payload);
  return payload;
}

}  // namespace tvg
