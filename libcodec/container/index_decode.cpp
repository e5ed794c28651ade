#include "base/checksum.hpp"
#include "container/layout.hpp"

#include <tvg/decoder.hpp>

namespace tvg {

namespace {

/// The payload of a chunk that fills `bytes` exactly.
Result<Bytes> whole_chunk(Bytes bytes, ChunkType type, const char* section) {
  const std::optional<ChunkHeader> header = read_chunk_header(bytes);
  if (!header || header->type != type || header->total_size() != bytes.size()) {
    return Error{ErrorCode::kMalformed, "there is no such chunk here", {}, {}, section};
  }
  const Bytes payload = bytes.subspan(kChunkHeaderSize, header->length);
  if (ByteReader(bytes.last(kChunkChecksumSize)).u32() != checksum(payload)) {
    return Error{ErrorCode::kChecksumMismatch, "the chunk is damaged", {}, {}, "§3.3"};
  }
  return payload;
}

}  // namespace

// format-spec §4.7
Result<ByteRange> locate_index(std::span<const std::uint8_t> tail, std::uint64_t stream_size) {
  const Result<Bytes> payload = whole_chunk(tail, kTailChunk, "§4.7");
  if (!payload) return payload.error();
  const Result<std::uint64_t> distance = read_tail(*payload);
  if (!distance) return distance.error();
  if (stream_size < kTailBytes || *distance > stream_size - kTailBytes) {
    return Error{ErrorCode::kMalformed, "the tail points before the stream", {}, {}, "§4.7"};
  }
  return ByteRange{stream_size - kTailBytes - *distance, *distance};
}

Result<std::vector<IndexEntry>> parse_index(std::span<const std::uint8_t> chunk) {
  const Result<Bytes> payload = whole_chunk(chunk, kIndexChunk, "§4.6");
  if (!payload) return payload.error();
  return read_index(*payload);
}

}  // namespace tvg
