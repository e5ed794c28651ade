#include "connectivity/coarse_mesh_encode.hpp"

#include "connectivity/connectivity_encode.hpp"
#include "connectivity/vertex_order_encode.hpp"

#include <deque>
#include <utility>

namespace tvg {

namespace {

std::vector<std::uint8_t> write_coarse_layouts(const CoarseLayouts& layouts) {
  ByteWriter section;
  section.varint(layouts.count);
  for (const CoarseLayout& mesh : std::span(layouts.meshes).first(layouts.count)) {
    section.varint(mesh.levels);
    section.varint(mesh.vertex_count);
    section.varint(mesh.face_count);
    section.varint(mesh.connectivity.size());
    section.bytes(mesh.connectivity);
    section.varint(mesh.order.size());
    section.bytes(mesh.order);
  }
  return section.take();
}

}  // namespace

std::vector<std::uint8_t> encode_coarse_meshes(const MeshLevels& levels,
                                               std::span<const std::uint32_t> order) {
  struct Coded {
    std::vector<std::uint8_t> connectivity, order;
  };
  std::deque<Coded> coded;  // which the layouts refer to
  CoarseLayouts layouts;
  for (const CoarseMesh& coarse : levels.coarse) {
    Mesh mesh;
    std::vector<std::uint32_t> number(levels.level.size());  // [vertex]: among those of the coarse mesh
    for (const std::uint32_t v : order) {
      if (levels.level[v] < coarse.levels) number[v] = mesh.vertex_count++;
    }
    for (const Face& face : coarse.faces)
      mesh.faces.push_back({number[face[0]], number[face[1]], number[face[2]]});
    EncodedConnectivity connectivity = encode_connectivity(mesh);
    const Coded& parts = coded.emplace_back(Coded{
        std::move(connectivity.bytes), encode_order(connectivity.order, connectivity.connectivity.gates)});
    layouts.meshes[layouts.count++] = {coarse.levels, mesh.vertex_count,
                                       static_cast<std::uint32_t>(mesh.faces.size()), parts.connectivity,
                                       parts.order};
  }
  return write_coarse_layouts(layouts);
}

}  // namespace tvg
