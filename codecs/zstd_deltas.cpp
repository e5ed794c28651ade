#include "codecs/other_codecs.hpp"
#include "codecs/packed_bytes.hpp"
#include "codecs/timing.hpp"

#include <cstring>

namespace tvg::bench {

namespace {

std::uint16_t zigzag(std::uint16_t delta) {
  return static_cast<std::uint16_t>((delta << 1) ^ (delta & 0x8000 ? 0xFFFF : 0));
}

std::uint16_t unzigzag(std::uint16_t code) {
  return static_cast<std::uint16_t>((code >> 1) ^ (code & 1 ? 0xFFFF : 0));
}
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

void frames_of_deltas(const Bytes& bytes, const Mesh& mesh, LatticeFrames& frames) {
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

CodecResult run_zstd_deltas(const LatticeSequence& sequence, int runs) {
  CodecResult result;
  result.name = "int16 deltas + zstd -19";
  Bytes packed;
  std::size_t size = 0;
  result.encode_seconds = best_time(runs, [&] {
    const Bytes bytes = delta_bytes(sequence);
    size = bytes.size();
    packed = zstd_compress(bytes);
  });
  result.bytes = packed.size();
  LatticeFrames frames = sequence.blank_frames();
  Bytes bytes(size);
  result.decode_seconds = best_time(runs, [&] {
    zstd_decompress(packed, bytes);
    frames_of_deltas(bytes, sequence.mesh, frames);
  });
  result.exact = frames == sequence.frames;
  return result;
}

}  // namespace tvg::bench
