#include "container/mesh_payload.hpp"

#include "base/stream_error.hpp"

namespace tvg {

std::vector<std::uint8_t> write_mesh(const MeshLayout& mesh) {
  ByteWriter writer;
  writer.varint(mesh.vertex_count);
  writer.varint(mesh.face_count);
  writer.u8(mesh.keeps_order ? 1 : 0);
  writer.varint(mesh.connectivity.size());
  writer.bytes(mesh.connectivity);
  writer.bytes(mesh.order);
  return writer.take();
}

// format-spec §4.3
Result<MeshLayout> read_mesh(Bytes payload) {
  ByteReader reader(payload);
  const std::uint64_t vertices = reader.varint();
  const std::uint64_t faces = reader.varint();
  const std::uint8_t order = reader.u8();
  const Bytes connectivity = reader.bytes(reader.varint());
  if (!reader.ok()) return malformed("§4.3", "the mesh chunk is too short");
  if (vertices == 0 || vertices >= 0x80000000u || faces >= 0x80000000u || order > 1) {
    return malformed("§4.3", "the mesh's counts or flags are out of range");
  }
  if (order == 0 && reader.left() != 0) return malformed("§4.3", "bytes follow a mesh without vertex order");
  return MeshLayout{static_cast<std::uint32_t>(vertices), static_cast<std::uint32_t>(faces), order == 1,
                    connectivity, reader.bytes(reader.left())};
}

// format-spec §4.1
Status check_mesh_size(const MeshLayout& mesh, const StreamLimits& limits) {
  if (mesh.vertex_count <= limits.vertices && mesh.face_count <= limits.faces) return {};
  return stream_error(ErrorCode::kLimitExceeded, "§4.1",
                      {"the mesh is larger than the stream's head declares"});
}

}  // namespace tvg
