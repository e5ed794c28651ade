#include "container/mesh_payload.hpp"

#include "base/stream_error.hpp"
#include "container/chunk.hpp"
#include "container/numbers.hpp"

#include <algorithm>

namespace tvg {

namespace {

// Kinds of sections.
constexpr std::uint64_t kConnectivity = 1;
constexpr std::uint64_t kParts = 2;
constexpr std::uint64_t kVertexOrder = 3;
constexpr std::uint64_t kAttributes = 4;
constexpr std::uint64_t kReferenceShape = 5;
constexpr std::uint64_t kPolygons = 6;
constexpr std::uint64_t kLevels = 7;
constexpr std::uint64_t kLods = 9;

void write_section(ByteWriter& writer, std::uint64_t kind, Bytes content) {
  writer.varint(kind);
  writer.varint(content.size());
  writer.bytes(content);
}

}  // namespace

std::vector<std::uint8_t> write_mesh(const MeshLayout& mesh) {
  ByteWriter writer;
  writer.varint(mesh.vertex_count);
  writer.varint(mesh.face_count);
  write_section(writer, kConnectivity, mesh.connectivity);
  if (!mesh.parts.empty()) write_section(writer, kParts, mesh.parts);
  if (mesh.keeps_order) write_section(writer, kVertexOrder, mesh.order);
  if (!mesh.attributes.empty()) write_section(writer, kAttributes, mesh.attributes);
  if (!mesh.shape.empty()) write_section(writer, kReferenceShape, mesh.shape);
  if (!mesh.polygons.empty()) write_section(writer, kPolygons, mesh.polygons);
  if (!mesh.levels.empty()) write_section(writer, kLevels, mesh.levels);
  if (!mesh.lods.empty()) write_section(writer, kLods, mesh.lods);
  return writer.take();
}

namespace {

// format-spec §4.3
Fault parse(ByteReader reader, MeshLayout& mesh) {
  constexpr const char* kSection = "§4.3";
  const std::uint64_t vertices = reader.varint();
  const std::uint64_t faces = reader.varint();
  if (!reader.ok()) return {kSection, "the mesh chunk is too short"};
  if (vertices == 0 || vertices > kMaxVertexCount || faces >= 0x80000000u)
    return {kSection, "the mesh's counts are out of range"};
  mesh.vertex_count = static_cast<std::uint32_t>(vertices);
  mesh.face_count = static_cast<std::uint32_t>(faces);
  bool has_connectivity = false;
  for (AscendingNumbers kinds; reader.left() > 0;) {
    const std::uint64_t kind = reader.varint();
    const Bytes content = reader.bytes(reader.varint());
    if (!reader.ok()) return {kSection, "the sections of the mesh do not fill its chunk exactly"};
    if (!kinds.take(kind)) return {"§3.5", "the sections of the mesh do not ascend"};
    if (kind == kConnectivity) {
      has_connectivity = true;
      mesh.connectivity = content;
    } else if (kind == kParts) {
      if (content.empty()) return {"§5.8", "the parts of the mesh are empty"};
      mesh.parts = content;
    } else if (kind == kVertexOrder) {
      mesh.keeps_order = true;
      mesh.order = content;
    } else if (kind == kAttributes) {
      if (content.empty()) return {"§5.7", "the attributes of the mesh are empty"};
      mesh.attributes = content;
    } else if (kind == kPolygons) {
      if (content.empty()) return {"§5.9", "the polygons of the mesh are empty"};
      mesh.polygons = content;
    } else if (kind == kReferenceShape) {
      if (content.empty()) return {"§5.3", "the reference shape of the mesh is empty"};
      mesh.shape = content;
    } else if (kind == kLevels) {
      if (content.empty()) return {"§5.5", "the levels of the mesh are empty"};
      mesh.levels = content;
    } else if (kind == kLods) {
      if (content.empty()) return {"§5.6", "the coarse meshes of the mesh are empty"};
      mesh.lods = content;
    } else if (is_required(kind)) {
      return {kSection, "the mesh has a section that this decoder does not know", ErrorCode::kUnsupported};
    }
  }
  if (!has_connectivity) return {kSection, "the mesh has no connectivity"};
  if (mesh.levels.empty() && !mesh.lods.empty()) return {"§5.6", "the mesh has coarse meshes and no levels"};
  return {};
}

}  // namespace

Result<MeshLayout> read_mesh(Bytes payload) {
  MeshLayout mesh{};
  if (const Fault fault = parse(ByteReader(payload), mesh)) return error_of(fault);
  return mesh;
}

std::uint32_t most_mesh_bytes(const StreamLimits& limits, bool with_shape, std::size_t coarse_meshes) {
  std::uint64_t bytes =
      64 + 16 * (1 + coarse_meshes) * (std::uint64_t{limits.vertices} + limits.faces) + 64 * coarse_meshes;
  if (with_shape) bytes += 64 + 24 * std::uint64_t{limits.vertices};
  bytes += 2 * std::uint64_t{limits.property_bytes};
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(bytes, kMaxChunkLength));
}

// format-spec §4.1
Status check_mesh_size(const MeshLayout& mesh, const StreamLimits& limits) {
  if (mesh.vertex_count <= limits.vertices && mesh.face_count <= limits.faces) return {};
  return stream_error(ErrorCode::kLimitExceeded, "§4.1",
                      {"the mesh is larger than the stream's head declares"});
}

}  // namespace tvg
