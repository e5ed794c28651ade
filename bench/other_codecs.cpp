#include "bench/other_codecs.hpp"

#include "bench/timing.hpp"

#include <algorithm>
#include <array>
#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>
#include <span>
#include <stdexcept>
#include <zstd.h>

namespace tvg::bench {

namespace {

using Bytes = std::vector<unsigned char>;
using Frames = std::vector<std::vector<std::uint16_t>>;

void require(bool success, const char* what) {
  if (!success) throw std::runtime_error(std::string(what) + " failed");
}

// ---- Draco ----

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

// ---- frame deltas ----

std::uint16_t zigzag(std::uint16_t delta) {
  return static_cast<std::uint16_t>((delta << 1) ^ (delta & 0x8000 ? 0xFFFF : 0));
}

std::uint16_t unzigzag(std::uint16_t code) {
  return static_cast<std::uint16_t>((code >> 1) ^ (code & 1 ? 0xFFFF : 0));
}

Bytes zstd_compress(std::span<const unsigned char> bytes) {
  Bytes packed(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 19);
  require(ZSTD_isError(size) == 0, "ZSTD_compress");
  packed.resize(size);
  return packed;
}

void zstd_decompress(const Bytes& packed, Bytes& bytes) {
  const std::size_t size = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
  require(size == bytes.size(), "ZSTD_decompress");
}

// ---- meshoptimizer ----

using PaddedVertex = std::array<std::uint16_t, 4>;

/// Vertices and triangles in the order that meshoptimizer's strip and vertex fetch optimizers give: of the
/// orders it offers, the one its vertex codec makes smallest.
struct Reordered {
  std::vector<unsigned int> indices;   ///< [face * 3 + corner], new numbers
  std::vector<std::uint32_t> sources;  ///< [new vertex] old number
};

Reordered reorder(const Mesh& mesh) {
  std::vector<unsigned int> indices;
  for (const Face& face : mesh.faces) indices.insert(indices.end(), face.begin(), face.end());
  Reordered result;
  result.indices.resize(indices.size());
  meshopt_optimizeVertexCacheStrip(result.indices.data(), indices.data(), indices.size(), mesh.vertex_count);
  std::vector<unsigned int> remap(mesh.vertex_count);
  std::size_t next = meshopt_optimizeVertexFetchRemap(remap.data(), result.indices.data(), indices.size(),
                                                      mesh.vertex_count);
  result.sources.resize(mesh.vertex_count);
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    if (remap[v] == ~0u) remap[v] = static_cast<unsigned int>(next++);  // in no triangle
    result.sources[remap[v]] = v;
  }
  for (unsigned int& index : result.indices) index = remap[index];
  return result;
}

struct MeshoptStream {
  Bytes indices;
  std::vector<Bytes> frames;

  std::size_t size() const {
    std::size_t total = indices.size();
    for (const Bytes& frame : frames) total += frame.size();
    return total;
  }
};

Bytes encode_indices(const Reordered& order, std::size_t vertex_count) {
  const std::size_t count = order.indices.size();
  Bytes bytes(meshopt_encodeIndexBufferBound(count, vertex_count));
  bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), order.indices.data(), count));
  return bytes;
}

MeshoptStream meshopt_encode(const LatticeSequence& sequence) {
  const std::size_t vertex_count = sequence.mesh.vertex_count;
  const Reordered order = reorder(sequence.mesh);
  MeshoptStream stream;
  stream.indices = encode_indices(order, vertex_count);
  std::vector<std::uint16_t> last(3 * vertex_count, 0);
  std::vector<PaddedVertex> deltas(vertex_count, PaddedVertex{});
  for (const std::vector<std::uint16_t>& frame : sequence.frames) {
    for (std::size_t v = 0; v < vertex_count; ++v) {
      const std::size_t source = 3 * std::size_t{order.sources[v]};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        deltas[v][axis] = static_cast<std::uint16_t>(frame[source + axis] - last[source + axis]);
      }
    }
    last = frame;
    Bytes bytes(meshopt_encodeVertexBufferBound(vertex_count, sizeof(PaddedVertex)));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), deltas.data(), vertex_count,
                                            sizeof(PaddedVertex)));
    stream.frames.push_back(std::move(bytes));
  }
  return stream;
}

void meshopt_decode(const MeshoptStream& stream, std::size_t vertex_count, std::size_t index_count,
                    Frames& frames) {
  std::vector<unsigned int> indices(index_count);
  require(meshopt_decodeIndexBuffer(indices.data(), index_count, sizeof(unsigned int), stream.indices.data(),
                                    stream.indices.size()) == 0,
          "meshopt_decodeIndexBuffer");
  std::vector<PaddedVertex> deltas(vertex_count);
  for (std::size_t f = 0; f < stream.frames.size(); ++f) {
    require(meshopt_decodeVertexBuffer(deltas.data(), vertex_count, sizeof(PaddedVertex),
                                       stream.frames[f].data(), stream.frames[f].size()) == 0,
            "meshopt_decodeVertexBuffer");
    for (std::size_t v = 0; v < vertex_count; ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint16_t before = f > 0 ? frames[f - 1][3 * v + axis] : std::uint16_t{0};
        frames[f][3 * v + axis] = static_cast<std::uint16_t>(before + deltas[v][axis]);
      }
    }
  }
}

bool same_in_order(const LatticeSequence& sequence, const Frames& frames) {
  const Reordered order = reorder(sequence.mesh);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (std::size_t v = 0; v < order.sources.size(); ++v) {
      const auto source = sequence.frames[f].begin() + 3 * std::ptrdiff_t{order.sources[v]};
      if (!std::equal(source, source + 3, frames[f].begin() + 3 * static_cast<std::ptrdiff_t>(v)))
        return false;
    }
  }
  return true;
}

Frames blank_frames(const LatticeSequence& sequence) {
  return Frames(sequence.frames.size(),
                std::vector<std::uint16_t>(3 * std::size_t{sequence.mesh.vertex_count}));
}

// ---- int16 deltas ----

/// Triangle indices as they are, then the deltas: for each frame and axis the low bytes of all vertices, then
/// the high bytes.
Bytes delta_bytes(const LatticeSequence& sequence) {
  const std::size_t vertex_count = sequence.mesh.vertex_count;
  const std::size_t index_bytes = sequence.mesh.faces.size() * sizeof(Face);
  Bytes bytes(index_bytes + sequence.frames.size() * vertex_count * 6);
  std::memcpy(bytes.data(), sequence.mesh.faces.data(), index_bytes);
  std::vector<std::uint16_t> last(3 * vertex_count, 0);
  std::size_t plane = index_bytes;
  for (const std::vector<std::uint16_t>& frame : sequence.frames) {
    for (std::size_t axis = 0; axis < 3; ++axis, plane += 2 * vertex_count) {
      for (std::size_t v = 0; v < vertex_count; ++v) {
        const std::size_t i = 3 * v + axis;
        const std::uint16_t code = zigzag(static_cast<std::uint16_t>(frame[i] - last[i]));
        bytes[plane + v] = static_cast<unsigned char>(code & 0xFF);
        bytes[plane + vertex_count + v] = static_cast<unsigned char>(code >> 8);
      }
    }
    last = frame;
  }
  return bytes;
}

void frames_of_deltas(const Bytes& bytes, const Mesh& mesh, Frames& frames) {
  const std::size_t vertex_count = mesh.vertex_count;
  std::size_t plane = mesh.faces.size() * sizeof(Face);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (std::size_t axis = 0; axis < 3; ++axis, plane += 2 * vertex_count) {
      for (std::size_t v = 0; v < vertex_count; ++v) {
        const std::size_t i = 3 * v + axis;
        const auto code =
            static_cast<std::uint16_t>(bytes[plane + v] | (bytes[plane + vertex_count + v] << 8));
        const std::uint16_t before = f > 0 ? frames[f - 1][i] : std::uint16_t{0};
        frames[f][i] = static_cast<std::uint16_t>(before + unzigzag(code));
      }
    }
  }
}

}  // namespace

CodecResult run_draco(const LatticeSequence& sequence) {
  CodecResult result;
  result.name = "Draco, each frame a mesh";
  std::vector<draco::EncoderBuffer> packets;
  std::vector<std::unique_ptr<draco::Mesh>> meshes;
  for (std::size_t f = 0; f < sequence.frames.size(); ++f) meshes.push_back(draco_mesh(sequence, f));
  result.encode_seconds = best_time([&] {
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
  result.decode_seconds = best_time([&] {
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

CodecResult run_meshoptimizer(const LatticeSequence& sequence) {
  CodecResult result;
  result.name = "meshoptimizer, frame deltas";
  MeshoptStream stream;
  result.encode_seconds = best_time([&] { stream = meshopt_encode(sequence); });
  result.bytes = stream.size();
  Frames frames = blank_frames(sequence);
  result.decode_seconds = best_time(
      [&] { meshopt_decode(stream, sequence.mesh.vertex_count, 3 * sequence.mesh.faces.size(), frames); });
  result.exact = same_in_order(sequence, frames);
  return result;
}

CodecResult run_meshoptimizer_zstd(const LatticeSequence& sequence) {
  CodecResult result;
  result.name = "the same + zstd -19";
  MeshoptStream stream;
  Bytes packed;
  result.encode_seconds = best_time([&] {
    stream = meshopt_encode(sequence);
    Bytes joined = stream.indices;
    for (const Bytes& frame : stream.frames) joined.insert(joined.end(), frame.begin(), frame.end());
    packed = zstd_compress(joined);
  });
  const std::size_t lengths = sizeof(std::uint32_t) * (1 + stream.frames.size());
  result.bytes = packed.size() + lengths;
  Frames frames = blank_frames(sequence);
  Bytes joined(stream.size());
  result.decode_seconds = best_time([&] {
    zstd_decompress(packed, joined);
    MeshoptStream parts = stream;  // its lengths; the bytes are replaced
    std::size_t next = 0;
    const auto take = [&](Bytes& part) {
      std::copy_n(joined.begin() + static_cast<std::ptrdiff_t>(next), part.size(), part.begin());
      next += part.size();
    };
    take(parts.indices);
    for (Bytes& frame : parts.frames) take(frame);
    meshopt_decode(parts, sequence.mesh.vertex_count, 3 * sequence.mesh.faces.size(), frames);
  });
  result.exact = same_in_order(sequence, frames);
  return result;
}

CodecResult run_zstd_deltas(const LatticeSequence& sequence) {
  CodecResult result;
  result.name = "int16 deltas + zstd -19";
  Bytes packed;
  std::size_t size = 0;
  result.encode_seconds = best_time([&] {
    const Bytes bytes = delta_bytes(sequence);
    size = bytes.size();
    packed = zstd_compress(bytes);
  });
  result.bytes = packed.size();
  Frames frames = blank_frames(sequence);
  Bytes bytes(size);
  result.decode_seconds = best_time([&] {
    zstd_decompress(packed, bytes);
    frames_of_deltas(bytes, sequence.mesh, frames);
  });
  result.exact = frames == sequence.frames;
  return result;
}

}  // namespace tvg::bench
