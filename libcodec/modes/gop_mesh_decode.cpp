#include "base/stream_error.hpp"
#include "modes/gop_mesh.hpp"
#include "planes/reference_shape.hpp"

#include <utility>

namespace tvg {

// format-spec §4.3, §5.3, §5.4
Result<GopMesh> decode_gop_mesh(const MeshLayout& layout, std::uint32_t id, const StreamLimits& limits,
                                std::uint32_t lod) {
  if (!layout.lods.empty() && limits.decoder_memory < decoder_memory_with_lods(limits)) {
    return error_of({"§8.2", "a mesh has coarse meshes, for which the stream declares too little memory",
                     ErrorCode::kLimitExceeded});
  }
  Result<CodedMesh> coded = decode_mesh(layout, id);
  if (!coded) return coded.error();
  GopMesh mesh;
  mesh.coded = std::move(*coded);
  if (Status status = decode_levels_of_mesh(layout, lod, mesh.coded); !status.ok()) return status.error();
  if (layout.shape.empty()) return mesh;
  if (limits.decoder_memory < decoder_memory_with_shapes(limits)) {
    return error_of({"§8.2", "a mesh has a reference shape, for which the stream declares too little memory",
                     ErrorCode::kLimitExceeded});
  }
  const Result<std::vector<Face>> faces = faces_by_traversal(mesh.coded);
  if (!faces) return faces.error();
  Result<ReferenceShape> shape = decode_reference_shape(layout.shape, *faces, layout.vertex_count);
  if (!shape) return shape.error();
  Result<Pyramid> pyramid =
      build_pyramid(*faces, layout.vertex_count, shape->indices, shape->neighbours, mesh.coded.levels);
  if (!pyramid) return pyramid.error();
  mesh.pyramid = std::move(*pyramid);
  mesh.shape = std::move(*shape);
  return mesh;
}

}  // namespace tvg
