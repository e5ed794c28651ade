#include "connectivity/mesh_coder_encode.hpp"

#include "base/checksum.hpp"
#include "connectivity/connectivity_encode.hpp"
#include "connectivity/vertex_order_encode.hpp"
#include "container/mesh_payload.hpp"

namespace tvg {

EncodedMesh encode_mesh(const Mesh& mesh, bool keep_order) {
  EncodedConnectivity encoded = encode_connectivity(mesh);
  std::vector<std::uint8_t> order;
  if (keep_order) order = encode_order(encoded.order, encoded.connectivity.gates);

  EncodedMesh result;
  result.payload = write_mesh(
      {mesh.vertex_count, static_cast<std::uint32_t>(mesh.faces.size()), keep_order, encoded.bytes, order});
  result.coded.mesh = mesh;
  result.coded.id = checksum(result.payload);
  result.coded.gates = std::move(encoded.connectivity.gates);
  result.coded.order = std::move(encoded.order);
  result.coded.info = {encoded.bytes.size(), order.size(), keep_order};
  return result;
}

}  // namespace tvg
