#pragma once
#include "base/byte_io.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tvg/source.hpp>
#include <tvg/types.hpp>

// What the structures of a stream look like in bytes (format-spec §3 and §4): the writer and the reader of
// each stand side by side. Nothing here knows geometry.
namespace tvg {

/// The first eight bytes of every stream (§3.1).
inline constexpr std::array<std::uint8_t, 8> kSignature = {0x8B, 'T', 'V', 'G', '\r', '\n', 0x1A, '\n'};

// --- chunks, §3.2 ---

using ChunkType = std::array<char, 4>;
inline constexpr ChunkType kHeadChunk = {'H', 'E', 'A', 'D'};
inline constexpr ChunkType kMetadataChunk = {'M', 'E', 'T', 'A'};
inline constexpr ChunkType kMeshChunk = {'M', 'E', 'S', 'H'};
inline constexpr ChunkType kGopChunk = {'G', 'O', 'P', ' '};
inline constexpr ChunkType kIndexChunk = {'I', 'N', 'D', 'X'};
inline constexpr ChunkType kTailChunk = {'T', 'A', 'I', 'L'};

inline constexpr std::size_t kChunkHeaderSize = 16;
inline constexpr std::size_t kChunkChecksumSize = 4;
inline constexpr std::uint32_t kMaxChunkLength = 0x7FFFFFFF;
/// Payloads of head, metadata and tail are no longer than this (§4.2).
inline constexpr std::uint32_t kMaxSmallPayload = 1u << 20;

struct ChunkHeader {
  ChunkType type;
  bool ancillary;        ///< a reader that does not know the type may skip the chunk
  std::uint32_t length;  ///< bytes of the payload

  /// The whole chunk: header, payload and payload checksum.
  std::uint64_t total_size() const { return kChunkHeaderSize + std::uint64_t{length} + kChunkChecksumSize; }
};

std::vector<std::uint8_t> write_chunk(ChunkType type, bool ancillary, Bytes payload);
/// Reads the 16 bytes of a header. Empty when they are not one: wrong checksum, reserved bits, letters or
/// length.
std::optional<ChunkHeader> read_chunk_header(Bytes bytes);

// --- payloads, §4 ---

std::vector<std::uint8_t> write_head(const StreamLimits& limits);
Result<StreamHead> read_head(Bytes payload);

std::vector<std::uint8_t> write_metadata(const Metadata& metadata);
Result<Metadata> read_metadata(Bytes payload);

/// §4.3: counts and the two coded parts; `order` is empty when the vertex order was given up.
struct MeshLayout {
  std::uint32_t vertex_count, face_count;
  bool keeps_order;
  Bytes connectivity, order;
};
std::vector<std::uint8_t> write_mesh(const MeshLayout& mesh);
Result<MeshLayout> read_mesh(Bytes payload);

/// §4.5.1: the first packet of a GOP.
struct GopHeader {
  std::uint64_t first_frame;  ///< number of the first frame in the sequence it was encoded from
  std::uint32_t frame_count;
  std::uint8_t predictor;
  std::uint8_t fine_bits, coarse_bits;
  std::array<double, 3> origin;
  double step;
  Bytes flags;  ///< coded flags; empty unless fine_bits > coarse_bits
};
std::vector<std::uint8_t> write_gop_header(const GopHeader& header);
Result<GopHeader> read_gop_header(Bytes packet);

/// §4.5: a packet is its size, its bytes and a checksum that also covers its place in the GOP.
void write_packet(ByteWriter& gop, std::uint64_t seed, Bytes packet);
/// The checksum's seed for packet `index` (1 for the first frame) of a GOP, from the checksums of its header
/// packet and of the mesh chunk it belongs to: a packet fits no other place, GOP or mesh.
constexpr std::uint64_t packet_seed(std::uint32_t header_checksum, std::uint32_t mesh_checksum,
                                    std::uint32_t index) {
  return (std::uint64_t{header_checksum ^ mesh_checksum} << 32) | index;
}

std::vector<std::uint8_t> write_index(const std::vector<IndexEntry>& entries);
Result<std::vector<IndexEntry>> read_index(Bytes payload);

/// §4.7: distance in bytes from the start of the tail chunk back to the start of the index chunk.
std::vector<std::uint8_t> write_tail(std::uint64_t index_distance);
Result<std::uint64_t> read_tail(Bytes payload);

}  // namespace tvg
