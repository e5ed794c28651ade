#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "container/chunk_reader.hpp"
#include "container/head.hpp"
#include "container/metadata.hpp"
#include "container/packet.hpp"

#include <algorithm>
#include <utility>

// What the reader makes of the content of chunks: payloads that are used whole, and the packets of a GOP.
namespace tvg {

std::optional<ChunkReader::Event> ChunkReader::use_payload(Bytes payload) {
  switch (kind_) {
    case ChunkKind::kHead:
      return use_head(payload);
    case ChunkKind::kMetadata: {
      Result<Metadata> metadata = read_metadata(payload);
      if (!metadata) return report(std::move(metadata.error()));
      metadata_ = std::move(*metadata);
      return Event::kMetadata;
    }
    case ChunkKind::kMesh:
      return use_mesh(payload);
    case ChunkKind::kIndex:
      return use_index(payload);
    default:
      return use_tail(payload);
  }
}

// format-spec §4.1, §8.1
ChunkReader::Event ChunkReader::use_head(Bytes payload) {
  Result<StreamHead> head = read_head(payload);
  if (!head) {
    head.error().byte_offset = chunk_offset_;
    return fail(std::move(head.error()));
  }
  if (Status status = check_declared(head->limits, caller_limits_); !status.ok()) {
    Error error = status.error();
    error.byte_offset = chunk_offset_;
    return fail(std::move(error));
  }
  head_ = *head;
  state_ = StreamState::kBody;
  return Event::kHead;
}

// format-spec §4.3
ChunkReader::Event ChunkReader::use_mesh(Bytes payload) {
  Result<MeshLayout> mesh = read_mesh(payload);
  Status status = mesh ? check_mesh_size(*mesh, head_.limits) : Status(std::move(mesh.error()));
  if (!status.ok()) {
    Error error = status.error();
    error.byte_offset = chunk_offset_;
    return lose(std::move(error), used_);
  }
  mesh_ = *mesh;
  has_mesh_ = true;
  mesh_offset_ = chunk_offset_;
  expected_index_.add(chunk_offset_, 0);
  return Event::kMesh;
}

// format-spec §4.6
ChunkReader::Event ChunkReader::use_index(Bytes payload) {
  Result<std::vector<IndexEntry>> index = read_index(payload, chunk_offset_);
  if (!index) return report(std::move(index.error()));
  index_ = std::move(*index);
  index_matches_ = !whole_ || expected_index_.matches(payload);
  return Event::kIndex;
}

// format-spec §4.7
std::optional<ChunkReader::Event> ChunkReader::use_tail(Bytes payload) {
  phase_ = Phase::kTail;
  state_ = StreamState::kEnd;
  Result<std::uint64_t> distance = read_tail(payload);
  if (!distance) return report(std::move(distance.error()));
  if (whole_ && index_offset_ && *distance != chunk_offset_ - *index_offset_)
    return report(malformed("§4.7", "the tail does not lead to the index"));
  consume(std::exchange(used_, std::size_t{0}));
  return std::nullopt;
}

/// Room for any packet of this mesh, so that frames do not allocate.
bool ChunkReader::reserve_for_packets() {
  constexpr std::uint64_t kAnyHeader = 4096;
  constexpr std::uint64_t kBytesPerVertex = 16;
  const std::uint64_t vertices = has_mesh_ ? mesh_.vertex_count : 0;
  return try_reserve(buffer_, static_cast<std::size_t>(std::min<std::uint64_t>(
                                  chunk_.length, kAnyHeader + kBytesPerVertex * vertices)));
}

// format-spec §4.5
std::optional<ChunkReader::Event> ChunkReader::next_packet() {
  const bool in_frames = packet_index_ > 0;
  if (in_frames && packet_index_ > std::uint64_t{gop_.frame_count} + 1) {
    if (payload_left_ == 0) {
      phase_ = Phase::kGopChecksum;
      return std::nullopt;
    }
    begin_search(0);
    return report(malformed("§4.5", "bytes follow a GOP's digest"));
  }
  const std::uint64_t seed =
      in_frames ? packet_seed(header_checksum_, mesh_checksum_, packet_index_) : std::uint64_t{0};
  const PacketRead packet = read_packet(available(), payload_left_, seed, head_.limits.packet_bytes);
  if (packet.state == PacketRead::State::kIncomplete) return need_bytes();
  if (packet.state != PacketRead::State::kWhole) {
    Error error = stream_error(ErrorCode::kChecksumMismatch, "§4.5", {"a packet is damaged"});
    return packet.state == PacketRead::State::kDamaged ? lose_unproven(std::move(error), packet.total)
                                                       : lose(std::move(error), 1);
  }
  used_ = packet.total;
  content_ = packet.content;
  payload_hash_.update(raw());
  payload_left_ -= packet.total;
  return use_packet(packet.checksum);
}

// format-spec §4.5.1
ChunkReader::Event ChunkReader::use_packet(std::uint32_t packet_checksum) {
  const std::uint32_t index = packet_index_++;
  if (index > gop_.frame_count) return Event::kDigest;
  if (index > 0) return Event::kFrame;
  Result<GopHeader> header = read_gop_header(content_);
  Status status = header ? check_gop_size(*header, head_.limits) : Status(std::move(header.error()));
  if (!status.ok()) {
    Error error = status.error();
    packet_index_ = 0;
    return lose(std::move(error), used_);
  }
  gop_ = *header;
  header_checksum_ = packet_checksum;
  if (!has_mesh_) {
    begin_search(used_);
    return Event::kOrphan;
  }
  expected_index_.add(chunk_offset_, gop_.frame_count);
  return Event::kGop;
}

// format-spec §3.3
std::optional<ChunkReader::Event> ChunkReader::end_gop() {
  if (available().size() < kChunkChecksumSize) return need_bytes();
  const std::uint32_t expected = ByteReader(available()).u32();
  phase_ = Phase::kChunkHeader;
  used_ = kChunkChecksumSize;
  if (expected == static_cast<std::uint32_t>(payload_hash_.value())) return Event::kGopEnd;
  return report(stream_error(ErrorCode::kChecksumMismatch, "§3.3",
                             {"the checksum of a GOP is damaged, its frames are not"}));
}

}  // namespace tvg
