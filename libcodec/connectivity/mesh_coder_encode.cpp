#include "connectivity/mesh_coder_encode.hpp"

#include "base/checksum.hpp"
#include "connectivity/coarse_mesh_encode.hpp"
#include "connectivity/connectivity_encode.hpp"
#include "connectivity/vertex_levels_encode.hpp"
#include "connectivity/vertex_order_encode.hpp"
#include "container/mesh_payload.hpp"

#include <algorithm>

namespace tvg {

namespace {

void add_levels(EncodedMesh& mesh, const MeshLevels& levels) {
  CodedMesh& coded = mesh.coded;
  for (const std::uint32_t v : coded.order) coded.levels.push_back(levels.level[v]);
  mesh.levels = encode_levels(coded.levels, coded.gates);
  coded.info.levels_bytes = mesh.levels.size();
  coded.info.levels = mesh.levels.front();
  if (levels.coarse.empty()) return;
  mesh.lods = encode_coarse_meshes(levels, coded.order);
  coded.info.lods_bytes = mesh.lods.size();
  for (const CoarseMesh& coarse : levels.coarse) {
    const auto vertices = std::count_if(coded.levels.begin(), coded.levels.end(),
                                        [&coarse](std::uint8_t level) { return level < coarse.levels; });
    coded.info.lods.push_back({coarse.levels, static_cast<std::uint32_t>(vertices),
                               static_cast<std::uint32_t>(coarse.faces.size()), 0});
  }
}

}  // namespace

EncodedMesh encode_mesh(const Mesh& mesh, bool keep_order, const MeshLevels* levels) {
  EncodedConnectivity encoded = encode_connectivity(mesh);
  EncodedMesh result;
  if (keep_order) result.order = encode_order(encoded.order, encoded.connectivity.gates);
  result.coded.mesh = mesh;
  result.coded.gates = std::move(encoded.connectivity.gates);
  result.coded.order = std::move(encoded.order);
  result.faces = std::move(encoded.connectivity.faces);
  result.first_corners = std::move(encoded.first_corners);
  result.coded.info = {encoded.bytes.size(), result.order.size(), 0, keep_order};
  result.connectivity = std::move(encoded.bytes);
  if (levels != nullptr) add_levels(result, *levels);
  return result;
}

std::vector<std::uint8_t> mesh_payload(EncodedMesh& mesh, std::span<const std::uint8_t> shape) {
  mesh.coded.info.shape_bytes = shape.size();
  std::vector<std::uint8_t> payload =
      write_mesh({mesh.coded.mesh.vertex_count, static_cast<std::uint32_t>(mesh.coded.mesh.faces.size()),
                  mesh.coded.info.keeps_vertex_order, mesh.connectivity, mesh.order, shape, mesh.levels,
                  mesh.lods, mesh.parts, mesh.attributes, mesh.polygons});
  mesh.coded.id = checksum(payload);
  return payload;
}

}  // namespace tvg
