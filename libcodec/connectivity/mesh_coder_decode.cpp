#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "connectivity/mesh_coder.hpp"
#include "connectivity/vertex_levels.hpp"
#include "connectivity/vertex_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tvg {

// format-spec §4.3
Result<CodedMesh> decode_mesh(const MeshLayout& layout, std::uint32_t id) {
  constexpr std::size_t kPerVertex = 48;
  if (!can_allocate_connectivity(layout.connectivity, layout.vertex_count, layout.face_count, kPerVertex))
    return out_of_memory();
  Result<Connectivity> connectivity =
      decode_connectivity(layout.connectivity, layout.vertex_count, layout.face_count);
  if (!connectivity) return connectivity.error();

  CodedMesh coded;
  coded.id = id;
  coded.info = sizes_of(layout);
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

MeshInfo sizes_of(const MeshLayout& layout) {
  MeshInfo info;
  info.connectivity_bytes = layout.connectivity.size();
  info.order_bytes = layout.order.size();
  info.shape_bytes = layout.shape.size();
  info.keeps_vertex_order = layout.keeps_order;
  info.levels_bytes = layout.levels.size();
  info.lods_bytes = layout.lods.size();
  info.parts_bytes = layout.parts.size();
  info.attributes_bytes = layout.attributes.size();
  info.polygons_bytes = layout.polygons.size();
  if (!layout.levels.empty()) info.levels = layout.levels.front();
  return info;
}

bool list_lods(const CoarseLayouts& layouts, std::vector<LodInfo>& lods) {
  if (!try_reserve(lods, layouts.count)) return false;
  for (const CoarseLayout& coarse : std::span(layouts.meshes).first(layouts.count)) {
    lods.push_back({coarse.levels, coarse.vertex_count, coarse.face_count,
                    coarse.connectivity.size() + coarse.order.size()});
  }
  return true;
}

// format-spec §5.5, §5.6
Status decode_levels_of_mesh(const MeshLayout& layout, std::uint32_t lod, CodedMesh& mesh) {
  if (layout.levels.empty()) return {};
  if (const Fault fault = decode_levels(layout.levels, mesh.gates, mesh.levels)) return error_of(fault);
  if (layout.lods.empty()) return {};
  CoarseLayouts layouts;
  if (const Fault fault = read_coarse_layouts(layout.lods, layout.face_count, layouts))
    return error_of(fault);
  if (const Fault fault = check_coarse_layouts(layouts, mesh.levels)) return error_of(fault);
  if (!list_lods(layouts, mesh.info.lods)) return out_of_memory();
  mesh.info.lod = std::min(lod, static_cast<std::uint32_t>(layouts.count));
  if (mesh.info.lod == 0) return {};
  Result<CoarseCut> cut = decode_coarse_mesh(layouts.meshes[mesh.info.lod - 1], mesh.levels, mesh.order);
  if (!cut) return cut.error();
  mesh.cut = std::move(*cut);
  return {};
}

}  // namespace tvg
