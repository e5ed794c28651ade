#pragma once
#include "base/byte_io.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <tvg/types.hpp>

// The signature and the frame around every part of a stream (format-spec §3.1 to §3.3).
namespace tvg {

/// The first eight bytes of every stream (§3.1).
inline constexpr std::array<std::uint8_t, 8> kSignature = {0x8B, 'T', 'V', 'G', '\r', '\n', 0x1A, '\n'};

using ChunkType = std::array<char, 4>;
inline constexpr ChunkType kHeadChunk = {'H', 'E', 'A', 'D'};
inline constexpr ChunkType kMetadataChunk = {'M', 'E', 'T', 'A'};
inline constexpr ChunkType kDataChunk = {'D', 'A', 'T', 'A'};
inline constexpr ChunkType kMeshChunk = {'M', 'E', 'S', 'H'};
inline constexpr ChunkType kPlanChunk = {'P', 'L', 'A', 'N'};
inline constexpr ChunkType kGopChunk = {'G', 'O', 'P', ' '};
inline constexpr ChunkType kIndexChunk = {'I', 'N', 'D', 'X'};
inline constexpr ChunkType kTailChunk = {'T', 'A', 'I', 'L'};

/// The type's four characters.
inline std::string_view text(const ChunkType& type) {
  return {type.data(), type.size()};
}

inline constexpr std::size_t kChunkHeaderSize = 16;
inline constexpr std::size_t kChunkChecksumSize = 4;
/// No chunk is shorter: a header and a payload checksum.
inline constexpr std::size_t kLeastChunkSize = kChunkHeaderSize + kChunkChecksumSize;
inline constexpr std::uint32_t kMaxChunkLength = 0x7FFFFFFF;
/// Bounds of payloads (§4.1, §4.2, §4.8).
inline constexpr std::uint32_t kMaxHeadPayload = 1u << 16;
inline constexpr std::uint32_t kMaxMetadataPayload = 1u << 20;
inline constexpr std::uint32_t kMaxDataPayload = (1u << 26) + 2048;

struct ChunkHeader {
  ChunkType type;
  bool ancillary;        ///< a reader that does not know the type may skip the chunk
  std::uint32_t length;  ///< bytes of the payload

  /// The whole chunk: header, payload and payload checksum.
  std::uint64_t total_size() const { return kLeastChunkSize + std::uint64_t{length}; }
};

std::vector<std::uint8_t> write_chunk(ChunkType type, bool ancillary, Bytes payload);
/// Reads the 16 bytes of a header. Empty when they are not one: wrong checksum, reserved bits, letters or
/// length.
std::optional<ChunkHeader> read_chunk_header(Bytes bytes);
/// The payload of a chunk of this type that fills `bytes` exactly; the section is named where it is not one.
Result<Bytes> read_whole_chunk(Bytes bytes, ChunkType type, const char* section);

}  // namespace tvg
