#include "container/layout.hpp"

#include "base/checksum.hpp"

#include <algorithm>
#include <cmath>

namespace tvg {

namespace {

Error malformed(const char* section, std::string message) {
  return {ErrorCode::kMalformed, std::move(message), {}, {}, section};
}

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

std::vector<std::uint8_t> write_head(const StreamLimits& limits) {
  ByteWriter head;
  head.u16(kFormatMajor);
  head.u16(kFormatMinor);
  head.u32(0);
  head.u32(limits.vertices);
  head.u32(limits.faces);
  head.u32(limits.frames_per_gop);
  head.u32(limits.packet_bytes);
  head.u64(limits.decoder_memory);
  return head.take();
}

// format-spec §4.1
Result<StreamHead> read_head(Bytes payload) {
  ByteReader reader(payload);
  StreamHead head;
  head.major = reader.u16();
  head.minor = reader.u16();
  if (!reader.ok()) return malformed("§4.1", "the head is too short");
  if (head.major != kFormatMajor || head.minor > kFormatMinor) {
    const auto text = [](int major, int minor) {
      return std::to_string(major) + "." + std::to_string(minor);
    };
    return Error{ErrorCode::kUnsupportedVersion,
                 "the stream has format version " + text(head.major, head.minor) +
                     ", this decoder reads up to " + text(kFormatMajor, kFormatMinor),
                 {},
                 {},
                 "§4.1"};
  }
  const std::uint32_t reserved = reader.u32();
  head.limits.vertices = reader.u32();
  head.limits.faces = reader.u32();
  head.limits.frames_per_gop = reader.u32();
  head.limits.packet_bytes = reader.u32();
  head.limits.decoder_memory = reader.u64();
  if (!reader.finished() || reserved != 0)
    return malformed("§4.1", "the head has a wrong size or reserved bits set");
  if (head.limits.decoder_memory != decoder_memory_needed(head.limits)) {
    return malformed("§4.1", "the declared decoder memory does not follow from the declared limits");
  }
  return head;
}

std::vector<std::uint8_t> write_metadata(const Metadata& metadata) {
  ByteWriter writer;
  writer.varint(metadata.size());
  for (const auto& [key, value] : metadata) {
    for (const std::string& text : {key, value}) {
      writer.varint(text.size());
      writer.bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    }
  }
  return writer.take();
}

// format-spec §4.2
Result<Metadata> read_metadata(Bytes payload) {
  ByteReader reader(payload);
  const std::uint64_t count = reader.varint();
  if (count > reader.left() / 2) return malformed("§4.2", "more metadata entries than bytes can hold");
  const auto text = [&reader] {
    const Bytes bytes = reader.bytes(reader.varint());
    return std::string(bytes.begin(), bytes.end());
  };
  Metadata metadata;
  for (std::uint64_t i = 0; i < count && reader.ok(); ++i) {
    std::string key = text();
    std::string value = text();
    if (key.empty() || (!metadata.empty() && key <= metadata.rbegin()->first)) {
      return malformed("§4.2", "metadata keys are empty or not in ascending order");
    }
    if (!is_metadata_text(key) || !is_metadata_text(value)) {
      return malformed("§4.2", "metadata are not text in UTF-8");
    }
    metadata.emplace_hint(metadata.end(), std::move(key), std::move(value));
  }
  if (!reader.finished()) return malformed("§4.2", "metadata entries do not fill the chunk exactly");
  return metadata;
}

std::vector<std::uint8_t> write_mesh(const MeshLayout& mesh) {
  ByteWriter writer;
  writer.varint(mesh.vertex_count);
  writer.varint(mesh.face_count);
  writer.u8(mesh.keeps_order ? 1 : 0);
  writer.varint(mesh.connectivity.size());
  writer.bytes(mesh.connectivity);
  writer.bytes(mesh.order);
  return writer.take();
}

// format-spec §4.3
Result<MeshLayout> read_mesh(Bytes payload) {
  ByteReader reader(payload);
  const std::uint64_t vertices = reader.varint();
  const std::uint64_t faces = reader.varint();
  const std::uint8_t order = reader.u8();
  const Bytes connectivity = reader.bytes(reader.varint());
  if (!reader.ok()) return malformed("§4.3", "the mesh chunk is too short");
  if (vertices == 0 || vertices > kMaxVertexCount || faces >= 0x80000000u || order > 1) {
    return malformed("§4.3", "the mesh's counts or flags are out of range");
  }
  if (order == 0 && reader.left() != 0) return malformed("§4.3", "bytes follow a mesh without vertex order");
  return MeshLayout{static_cast<std::uint32_t>(vertices), static_cast<std::uint32_t>(faces), order == 1,
                    connectivity, reader.bytes(reader.left())};
}

std::vector<std::uint8_t> write_gop_header(const GopHeader& header) {
  ByteWriter writer;
  writer.u8(0);  // mode 0: frames on the lattice
  writer.u8(header.predictor);
  writer.u8(header.fine_bits);
  writer.u8(header.coarse_bits);
  for (const double coordinate : header.origin) writer.f64(coordinate);
  writer.f64(header.step);
  writer.varint(header.first_frame);
  writer.varint(header.frame_count);
  writer.bytes(header.flags);
  return writer.take();
}

// format-spec §4.5.1
Result<GopHeader> read_gop_header(Bytes packet) {
  ByteReader reader(packet);
  GopHeader header{};
  const std::uint8_t mode = reader.u8();
  header.predictor = reader.u8();
  header.fine_bits = reader.u8();
  header.coarse_bits = reader.u8();
  for (double& coordinate : header.origin) coordinate = reader.f64();
  header.step = reader.f64();
  header.first_frame = reader.varint();
  const std::uint64_t frame_count = reader.varint();
  if (!reader.ok()) return malformed("§4.5.1", "the GOP's header is too short");
  if (mode != 0 || header.predictor > static_cast<std::uint8_t>(Predictor::kElp)) {
    return malformed("§4.5.1", "the GOP's mode or predictor is unknown");
  }
  if (header.coarse_bits < kMinBits || header.coarse_bits > header.fine_bits || header.fine_bits > kMaxBits) {
    return malformed("§4.5.1", "the GOP's bits are out of range");
  }
  const bool finite =
      std::all_of(header.origin.begin(), header.origin.end(), [](double x) { return std::isfinite(x); });
  if (!finite || !std::isfinite(header.step) || header.step <= 0) {
    return malformed("§4.5.1", "the GOP's lattice has no finite origin or no positive step");
  }
  if (frame_count == 0 || frame_count > 0xFFFFFFFF || header.first_frame > (std::uint64_t{1} << 62)) {
    return malformed("§4.5.1", "the GOP's frame numbers are out of range");
  }
  header.frame_count = static_cast<std::uint32_t>(frame_count);
  header.flags = reader.bytes(reader.left());
  if (header.fine_bits == header.coarse_bits && !header.flags.empty()) {
    return malformed("§4.5.1", "a GOP with one lattice carries flags");
  }
  return header;
}

void write_packet(ByteWriter& gop, std::uint64_t seed, Bytes packet) {
  gop.varint(packet.size());
  gop.bytes(packet);
  gop.u32(checksum(packet, seed));
}

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

// format-spec §4.6
Result<std::vector<IndexEntry>> read_index(Bytes payload) {
  ByteReader reader(payload);
  const std::uint64_t count = reader.varint();
  if (count > reader.left() / 2) return malformed("§4.6", "more index entries than bytes can hold");
  std::vector<IndexEntry> entries;
  entries.reserve(static_cast<std::size_t>(count));
  std::uint64_t offset = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t frames = reader.varint();
    const std::uint64_t distance = reader.varint();
    if (!reader.ok() || distance == 0 || distance > (std::uint64_t{1} << 62) - offset ||
        frames > 0xFFFFFFFF) {
      return malformed("§4.6", "an index entry is out of range");
    }
    offset += distance;
    entries.push_back({frames == 0 ? IndexEntry::Kind::kMesh : IndexEntry::Kind::kGop, offset,
                       static_cast<std::uint32_t>(frames)});
  }
  if (!reader.finished()) return malformed("§4.6", "index entries do not fill the chunk exactly");
  return entries;
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

}  // namespace tvg
