#include "codecs/other_codecs.hpp"
#include "codecs/packed_bytes.hpp"
#include "codecs/timing.hpp"

#include <algorithm>
#include <array>
#include <meshoptimizer.h>

namespace tvg::bench {

namespace {

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
                    LatticeFrames& frames) {
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

bool same_in_order(const LatticeSequence& sequence, const LatticeFrames& frames) {
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

}  // namespace

CodecResult run_meshoptimizer(const LatticeSequence& sequence, int runs) {
  CodecResult result;
  result.name = "meshoptimizer, frame deltas";
  MeshoptStream stream;
  result.encode_seconds = best_time(runs, [&] { stream = meshopt_encode(sequence); });
  result.bytes = stream.size();
  LatticeFrames frames = sequence.blank_frames();
  result.decode_seconds = best_time(runs, [&] {
    meshopt_decode(stream, sequence.mesh.vertex_count, 3 * sequence.mesh.faces.size(), frames);
  });
  result.exact = same_in_order(sequence, frames);
  return result;
}

CodecResult run_meshoptimizer_zstd(const LatticeSequence& sequence, int runs) {
  CodecResult result;
  result.name = "the same + zstd -19";
  MeshoptStream stream;
  Bytes packed;
  result.encode_seconds = best_time(runs, [&] {
    stream = meshopt_encode(sequence);
    Bytes joined = stream.indices;
    for (const Bytes& frame : stream.frames) joined.insert(joined.end(), frame.begin(), frame.end());
    packed = zstd_compress(joined);
  });
  const std::size_t lengths = sizeof(std::uint32_t) * (1 + stream.frames.size());
  result.bytes = packed.size() + lengths;
  LatticeFrames frames = sequence.blank_frames();
  Bytes joined(stream.size());
  result.decode_seconds = best_time(runs, [&] {
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

}  // namespace tvg::bench
