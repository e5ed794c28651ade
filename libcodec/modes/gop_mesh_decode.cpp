#include "attributes/mesh_properties.hpp"
#include "base/stream_error.hpp"
#include "modes/gop_mesh.hpp"
#include "planes/reference_shape.hpp"

#include <utility>

namespace tvg {

namespace {

// format-spec §5.3, §5.4
Status decode_shape(const MeshLayout& layout, std::span<const Face> faces, const StreamLimits& limits,
                    GopMesh& mesh) {
  if (layout.shape.empty()) return {};
  if (limits.decoder_memory < decoder_memory_with_shapes(limits)) {
    return error_of({"§8.2", "a mesh has a reference shape, for which the stream declares too little memory",
                     ErrorCode::kLimitExceeded});
  }
  Result<ReferenceShape> shape = decode_reference_shape(layout.shape, faces, layout.vertex_count);
  if (!shape) return shape.error();
  Result<Pyramid> pyramid =
      build_pyramid(faces, layout.vertex_count, shape->indices, shape->neighbours, mesh.coded.levels);
  if (!pyramid) return pyramid.error();
  mesh.pyramid = std::move(*pyramid);
  mesh.shape = std::move(*shape);
  return {};
}

}  // namespace

// format-spec §4.3
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
  const Result<std::vector<Face>> faces = faces_by_traversal(mesh.coded);
  if (!faces) return faces.error();
  if (Status status = decode_shape(layout, *faces, limits, mesh); !status.ok()) return status.error();
  if (mesh.coded.info.lod > 0) return mesh;
  Result<MeshProperties> properties = decode_properties(
      layout, mesh.coded, *faces, layout.shape.empty() ? nullptr : &mesh.shape, limits, mesh.animated);
  if (!properties) return properties.error();
  mesh.properties = std::move(*properties);
  return mesh;
}

}  // namespace tvg
