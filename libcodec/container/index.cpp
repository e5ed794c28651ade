#include "container/index.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "container/chunk.hpp"
#include "container/gop_header.hpp"

#include <array>
#include <optional>
#include <span>
#include <utility>

namespace tvg {

namespace {

constexpr std::uint64_t kMostOffset = std::uint64_t{1} << 62;

/// Reads entry after entry.
class IndexReader {
 public:
  IndexReader(Bytes payload, std::uint64_t index_offset) : reader_(payload), index_offset_(index_offset) {}

  Result<Index> run() {
    if (const Fault fault = read_all()) return error_of(fault);
    return std::move(index_);
  }

 private:
  static constexpr const char* kSection = "§4.6";
  static constexpr std::uint64_t kLeastEntryBytes = 3;

  Fault read_all() {
    const std::uint64_t count = reader_.varint();
    if (!reader_.ok() || count > reader_.left() / kLeastEntryBytes)
      return {kSection, "more index entries than bytes can hold"};
    if (!try_reserve(index_.entries, static_cast<std::size_t>(count)))
      return {"", "out of memory", ErrorCode::kOutOfMemory};
    for (std::uint64_t i = 0; i < count; ++i) {
      if (const Fault fault = read_entry()) return fault;
    }
    return reader_.finished() ? Fault() : Fault{kSection, "index entries do not fill the chunk exactly"};
  }

  Fault read_entry() {
    const std::uint64_t kind = reader_.varint();
    const std::uint64_t distance = reader_.varint();
    ByteReader fields(reader_.bytes(reader_.varint()));
    if (!reader_.ok()) return {kSection, "index entries do not fill the chunk exactly"};
    if (distance == 0 || distance > kMostOffset - offset_)
      return {kSection, "an index entry is out of range"};
    offset_ += distance;
    if (offset_ >= index_offset_) return {kSection, "an index entry points behind the index"};
    using Kind = IndexEntry::Kind;
    if (kind == 0 || kind > static_cast<std::uint64_t>(Kind::kDependentGop)) return {};
    IndexEntry entry;
    entry.kind = static_cast<Kind>(kind);
    entry.offset = offset_;
    if (entry.kind == Kind::kMesh) ++meshes_;
    if (entry.kind == Kind::kPlan) ++planes_;
    if (entry.is_gop()) {
      if (const Fault fault = read_gop(fields, entry)) return fault;
    }
    if (!fields.finished()) return {kSection, "the fields of an index entry do not fill it exactly"};
    index_.digest.add(entry);
    index_.entries.push_back(std::move(entry));
    return {};
  }

  Fault read_gop(ByteReader& fields, IndexEntry& entry) {
    constexpr Fault kOutOfRange{kSection, "a GOP's index entry is out of range"};
    const std::uint64_t frames = fields.varint();
    const std::uint64_t meshes_back = fields.varint();
    const std::uint64_t count = fields.varint();
    if (!fields.ok() || frames == 0 || frames > 0xFFFFFFFF || meshes_back == 0 || meshes_back > meshes_ ||
        meshes_back > 0xFFFFFFFF || count > back_.size()) {
      return kOutOfRange;
    }
    entry.frame_count = static_cast<std::uint32_t>(frames);
    entry.meshes_back = static_cast<std::uint32_t>(meshes_back);
    const auto planes_back = std::span(back_).first(static_cast<std::size_t>(count));
    for (std::uint64_t& back : planes_back) {
      back = fields.varint();
      if (!fields.ok() || back == 0 || back > planes_) return kOutOfRange;
    }
    std::optional<PlaneList> planes = PlaneList::of(planes_back);
    if (!planes) return {"", "out of memory", ErrorCode::kOutOfMemory};
    entry.planes_back = *std::move(planes);
    return {};
  }

  ByteReader reader_;
  std::uint64_t index_offset_;
  Index index_;
  std::uint64_t offset_ = 0;
  std::uint64_t meshes_ = 0, planes_ = 0;                     ///< entries so far
  std::array<std::uint64_t, GopHeader::kMostPlanes> back_{};  ///< of the GOP being read
};

}  // namespace

void IndexDigest::add(const IndexEntry& entry) {
  const std::span<const std::uint64_t> planes = entry.planes_back.numbers();
  const auto hash = [this](std::uint64_t value) {
    const std::array halves = {static_cast<std::int32_t>(value), static_cast<std::int32_t>(value >> 32)};
    hash_.update(std::span<const std::int32_t>(halves));
  };
  for (const std::uint64_t value :
       {static_cast<std::uint64_t>(entry.kind), entry.offset, std::uint64_t{entry.frame_count},
        std::uint64_t{entry.meshes_back}, std::uint64_t{planes.size()}}) {
    hash(value);
  }
  for (const std::uint64_t back : planes) hash(back);
  ++count_;
}

std::vector<std::uint8_t> write_index(const std::vector<IndexEntry>& entries) {
  ByteWriter writer;
  writer.varint(entries.size());
  std::uint64_t offset = 0;
  for (const IndexEntry& entry : entries) {
    writer.varint(static_cast<std::uint64_t>(entry.kind));
    writer.varint(entry.offset - offset);
    offset = entry.offset;
    ByteWriter fields;
    if (entry.is_gop()) {
      fields.varint(entry.frame_count);
      fields.varint(entry.meshes_back);
      fields.varint(entry.planes_back.numbers().size());
      for (const std::uint64_t back : entry.planes_back.numbers()) fields.varint(back);
    }
    writer.varint(fields.data().size());
    writer.bytes(fields.data());
  }
  return writer.take();
}

std::uint64_t most_index_bytes(std::uint64_t entries) {
  return (std::uint64_t{1} << 20) + 1024 * entries;
}

// format-spec §4.6
Result<Index> read_index(Bytes payload, std::uint64_t index_offset) {
  return IndexReader(payload, index_offset).run();
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
  Result<Index> index = read_index(*payload);
  if (!index) return index.error();
  return std::move(index->entries);
}

}  // namespace tvg
