#include "container/chunk.hpp"

#include "base/checksum.hpp"
#include "base/stream_error.hpp"

#include <algorithm>

namespace tvg {

namespace {

constexpr std::uint32_t kAncillaryFlag = 1;

}  // namespace

std::vector<std::uint8_t> write_chunk(ChunkType type, bool ancillary, Bytes payload) {
  ByteWriter chunk;
  for (const char letter : type) chunk.u8(static_cast<std::uint8_t>(letter));
  chunk.u32(ancillary ? kAncillaryFlag : 0);
  chunk.u32(static_cast<std::uint32_t>(payload.size()));
  chunk.u32(checksum(chunk.data()));
  chunk.bytes(payload);
  chunk.u32(checksum(payload));
  return chunk.take();
}

// format-spec §3.2
std::optional<ChunkHeader> read_chunk_header(Bytes bytes) {
  ByteReader reader(bytes.first(std::min(bytes.size(), kChunkHeaderSize)));
  ChunkHeader header{};
  for (char& letter : header.type) letter = static_cast<char>(reader.u8());
  const std::uint32_t flags = reader.u32();
  header.length = reader.u32();
  const std::uint32_t expected = reader.u32();
  if (!reader.finished() || expected != checksum(bytes.first(kChunkHeaderSize - 4))) return std::nullopt;
  const bool letters =
      std::all_of(header.type.begin(), header.type.end(), [](char c) { return c >= ' ' && c <= '~'; });
  if (!letters || flags > kAncillaryFlag || header.length > kMaxChunkLength) return std::nullopt;
  header.ancillary = flags == kAncillaryFlag;
  return header;
}

// format-spec §3.2, §3.3
Result<Bytes> read_whole_chunk(Bytes bytes, ChunkType type, const char* section) {
  const std::optional<ChunkHeader> header = read_chunk_header(bytes);
  if (!header || header->type != type || header->total_size() != bytes.size()) {
    return malformed(section, "there is no such chunk here");
  }
  const Bytes payload = bytes.subspan(kChunkHeaderSize, header->length);
  if (ByteReader(bytes.last(kChunkChecksumSize)).u32() != checksum(payload)) {
    return stream_error(ErrorCode::kChecksumMismatch, "§3.3", {"the chunk is damaged"});
  }
  return payload;
}

}  // namespace tvg
