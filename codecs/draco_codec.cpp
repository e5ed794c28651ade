#include "codecs/other_codecs.hpp"
#include "codecs/packed_bytes.hpp"
#include "codecs/timing.hpp"

#include <algorithm>
#include <array>
#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <memory>

namespace tvg::bench {

namespace {

std::unique_ptr<draco::Mesh> draco_mesh(const LatticeSequence& sequence, std::size_t frame) {
  auto mesh = std::make_unique<draco::Mesh>();
  const std::uint32_t vertex_count = sequence.mesh.vertex_count;
  for (const Face& face : sequence.mesh.faces) {
    mesh->AddFace({draco::PointIndex(face[0]), draco::PointIndex(face[1]), draco::PointIndex(face[2])});
  }
  mesh->set_num_points(vertex_count);
  draco::GeometryAttribute layout;
  layout.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_INT32, false,
              3 * sizeof(std::int32_t), 0);
  const int id = mesh->AddAttribute(layout, true, vertex_count);
  const std::vector<std::uint16_t>& values = sequence.frames[frame];
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    const std::array<std::int32_t, 3> position = {values[3 * v], values[3 * v + 1], values[3 * v + 2]};
    mesh->attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), position.data());
  }
  return mesh;
}

using Position = std::array<std::int32_t, 3>;

/// The different positions that triangles use, sorted: what is left of a frame when vertices lose their
/// numbers.
std::vector<Position> positions_used(const LatticeSequence& sequence, std::size_t frame) {
  const std::vector<std::uint16_t>& values = sequence.frames[frame];
  std::vector<Position> positions;
  for (const Face& face : sequence.mesh.faces) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;  // Draco drops these
    for (const std::uint32_t v : face)
      positions.push_back({values[3 * v], values[3 * v + 1], values[3 * v + 2]});
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

std::vector<Position> positions_used(const draco::Mesh& mesh) {
  const draco::PointAttribute* attribute = mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  std::vector<Position> positions(mesh.num_points());
  for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
    attribute->ConvertValue(attribute->mapped_index(draco::PointIndex(p)), positions[p].data());
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

}  // namespace

CodecResult run_draco(const LatticeSequence& sequence, int runs) {
  CodecResult result;
  result.name = "Draco, each frame a mesh";
  std::vector<draco::EncoderBuffer> packets;
  std::vector<std::unique_ptr<draco::Mesh>> meshes;
  for (std::size_t f = 0; f < sequence.frames.size(); ++f) meshes.push_back(draco_mesh(sequence, f));
  result.encode_seconds = best_time(runs, [&] {
    packets = std::vector<draco::EncoderBuffer>(meshes.size());
    for (std::size_t f = 0; f < meshes.size(); ++f) {
      draco::Encoder encoder;
      encoder.SetSpeedOptions(0, 0);
      encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
      require(encoder.EncodeMeshToBuffer(*meshes[f], &packets[f]).ok(), "draco::Encoder");
    }
  });
  for (const draco::EncoderBuffer& packet : packets) result.bytes += packet.size();

  std::vector<std::unique_ptr<draco::Mesh>> decoded(packets.size());
  result.decode_seconds = best_time(runs, [&] {
    for (std::size_t f = 0; f < packets.size(); ++f) {
      draco::DecoderBuffer buffer;
      buffer.Init(packets[f].data(), packets[f].size());
      auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
      require(mesh.ok(), "draco::Decoder");
      decoded[f] = std::move(mesh).value();
    }
  });
  result.exact = true;
  for (std::size_t f = 0; f < decoded.size(); ++f) {
    result.exact = result.exact && positions_used(sequence, f) == positions_used(*decoded[f]);
  }
  return result;
}

}  // namespace tvg::bench
