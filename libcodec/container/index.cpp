#include "container/index.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "container/chunk.hpp"

#include <array>

namespace tvg {

std::vector<std::uint8_t> write_index(const std::vector<IndexEntry>& entries) {
  ByteWriter writer;
  writer.varint(entries.size());
  std::uint64_t offset = 0;
  for (const IndexEntry& entry : entries) {
    writer.varint(entry.kind == IndexEntry::Kind::kMesh ? 0 : entry.frame_count);
    writer.varint(entry.offset - offset);
    offset = entry.offset;
  }
  return writer.take();
}

std::uint64_t most_index_bytes(std::uint64_t offset) {
  constexpr std::uint64_t kMostCountBytes = 10;
  constexpr std::uint64_t kMostEntryBytes = 5 + 9;  // frames below 2^32, a distance up to 2^62
  return kMostCountBytes + kMostEntryBytes * (offset / kLeastChunkSize);
}

// format-spec §4.6
Result<std::vector<IndexEntry>> read_index(Bytes payload, std::uint64_t index_offset) {
  ByteReader reader(payload);
  const std::uint64_t count = reader.varint();
  if (count > reader.left() / 2 || count > index_offset / kLeastChunkSize)
    return malformed("§4.6", "more index entries than bytes can hold");
  std::vector<IndexEntry> entries;
  if (!try_reserve(entries, static_cast<std::size_t>(count))) return out_of_memory();
  std::uint64_t offset = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t frames = reader.varint();
    const std::uint64_t distance = reader.varint();
    if (!reader.ok() || distance == 0 || distance > (std::uint64_t{1} << 62) - offset ||
        frames > 0xFFFFFFFF) {
      return malformed("§4.6", "an index entry is out of range");
    }
    offset += distance;
    if (offset >= index_offset) return malformed("§4.6", "an index entry points behind the index");
    entries.push_back({frames == 0 ? IndexEntry::Kind::kMesh : IndexEntry::Kind::kGop, offset,
                       static_cast<std::uint32_t>(frames)});
  }
  if (!reader.finished()) return malformed("§4.6", "index entries do not fill the chunk exactly");
  return entries;
}

void ExpectedIndex::add(std::uint64_t offset, std::uint32_t frame_count) {
  if (offset <= last_offset_) return;
  std::array<std::uint8_t, 20> bytes;
  std::size_t size = 0;
  for (std::uint64_t value : {std::uint64_t{frame_count}, offset - last_offset_}) {
    for (; value >= 0x80; value >>= 7) bytes[size++] = static_cast<std::uint8_t>(value | 0x80);
    bytes[size++] = static_cast<std::uint8_t>(value);
  }
  digest_.update(Bytes(bytes).first(size));
  last_offset_ = offset;
  ++count_;
}

bool ExpectedIndex::matches(Bytes payload) const {
  ByteReader reader(payload);
  if (reader.varint() != count_ || !reader.ok()) return false;
  Hasher digest;
  digest.update(payload.subspan(reader.position()));
  return digest.value() == digest_.value();
}

std::vector<std::uint8_t> write_tail(std::uint64_t index_distance) {
  ByteWriter writer;
  writer.u64(index_distance);
  return writer.take();
}

// format-spec §4.7
Result<std::uint64_t> read_tail(Bytes payload) {
  ByteReader reader(payload);
  const std::uint64_t distance = reader.u64();
  if (!reader.finished()) return malformed("§4.7", "the tail has a wrong size");
  return distance;
}

// format-spec §4.7
Result<ByteRange> locate_index(std::span<const std::uint8_t> tail, std::uint64_t stream_size) {
  const Result<Bytes> payload = read_whole_chunk(tail, kTailChunk, "§4.7");
  if (!payload) return payload.error();
  const Result<std::uint64_t> distance = read_tail(*payload);
  if (!distance) return distance.error();
  if (stream_size < kTailBytes || *distance > stream_size - kTailBytes) {
    return malformed("§4.7", "the tail points before the stream");
  }
  return ByteRange{stream_size - kTailBytes - *distance, *distance};
}

// format-spec §4.6
Result<std::vector<IndexEntry>> parse_index(std::span<const std::uint8_t> chunk) {
  const Result<Bytes> payload = read_whole_chunk(chunk, kIndexChunk, "§4.6");
  if (!payload) return payload.error();
  return read_index(*payload);
}

}  // namespace tvg
