#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "container/chunk_reader.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

// The packets of a GOP, one by one (format-spec §4.5).
namespace tvg {

/// Room for any packet of a mesh in force, so that frames do not allocate.
bool ChunkReader::reserve_for_packets() {
  constexpr std::uint64_t kAnyHeader = 4096;
  constexpr std::uint64_t kBytesPerVertex = 16;
  std::uint64_t vertices = 0;
  for (const ChunkWindow::Entry& mesh : meshes_.entries()) vertices = std::max(vertices, mesh.number);
  return try_reserve(buffer_, static_cast<std::size_t>(std::min<std::uint64_t>(
                                  chunk_.length, kAnyHeader + kBytesPerVertex * vertices)));
}

std::optional<ChunkReader::Event> ChunkReader::next_packet() {
  const bool header_read = packet_number_ > 0;
  if (header_read && packet_number_ > gop_.packet_count) return end_packets();
  const std::uint64_t seed = header_read ? packet_seed(header_checksum_, packet_number_) : 0;
  const PacketRead packet = read_packet(available(), payload_left_, seed, head_.limits.packet_bytes);
  switch (packet.state) {
    case PacketRead::State::kIncomplete:
      return need_bytes();
    case PacketRead::State::kBeyond:
      return lose(malformed("§4.5", "the GOP ends before its packets do"), 1);
    case PacketRead::State::kTooLarge:
      return lose(
          stream_error(ErrorCode::kLimitExceeded, "§4.1", {"a packet is larger than the head declares"}), 1);
    case PacketRead::State::kDamaged:
      return lose_unproven(stream_error(ErrorCode::kChecksumMismatch, "§4.5", {"a packet is damaged"}),
                           packet.total);
    case PacketRead::State::kWhole:
      break;
  }
  used_ = packet.total;
  content_ = packet.content;
  payload_hash_.update(raw());
  payload_left_ -= packet.total;
  return use_packet(packet);
}

ChunkReader::Event ChunkReader::use_packet(const PacketRead& packet) {
  namespace kind = packet_kind;
  if (packet_number_ == 0) {
    header_checksum_ = packet.checksum;
    return packet.kind == kind::kHeader ? use_gop_header()
                                        : misplaced("a GOP does not begin with its header");
  }
  ++packet_number_;
  if (packet.kind >= kind::kAncillary) return Event::kPacket;
  if (packet.kind == kind::kHeader) return misplaced("a GOP has a second header");
  if (packet.kind == kind::kDigest) {
    if (digest_met_) return misplaced("a GOP has a second digest");
    if (frames_met_ < gop_.frame_count) return misplaced("the digest of a GOP comes before its last frame");
    digest_met_ = true;
    return Event::kDigest;
  }
  if (!kind::is_frame(packet.kind)) {
    const Event event = report(error_of(
        {"§4.5", "the GOP has a packet of a kind that this decoder does not know", ErrorCode::kUnsupported}));
    problem_.loses = frames_met_ < gop_.frame_count;
    phase_ = Phase::kPassOver;
    return event;
  }
  if (frames_met_ == gop_.frame_count) return misplaced("a GOP has more frames than its header says");
  ++frames_met_;
  predictor_ = static_cast<Predictor>(packet.kind - kind::kFrame);
  return Event::kFrame;
}

/// A packet stands where it may not: the frames before it are in doubt, too.
ChunkReader::Event ChunkReader::misplaced(const char* sentence) {
  const bool header_read = packet_number_ > 0;
  const Event event = lose(malformed("§4.5", sentence), used_);
  problem_.doubts = problem_.loses && header_read;
  return event;
}

// format-spec §4.5.1
ChunkReader::Event ChunkReader::use_gop_header() {
  Result<GopHeader> header = read_gop_header(content_);
  Status status = header ? check_gop_size(*header, head_.limits) : Status(std::move(header.error()));
  if (!status.ok()) return lose(status.error(), used_);
  gop_ = *header;
  const auto* const mesh = meshes_.find(gop_.mesh);
  if (mesh == nullptr) {
    const char* const section = state_ == StreamState::kOpen ? "§3.4" : "§4.5.1";
    return lose_gop({section, "the mesh of a GOP is not in force"});
  }
  PlaneList planes_back;
  if (const Fault fault = find_planes(*mesh, planes_back)) return lose_gop(fault);
  expected_index_.add({.offset = chunk_offset_,
                       .frame_count = gop_.frame_count,
                       .meshes_back = static_cast<std::uint32_t>(meshes_.back(*mesh)),
                       .kind = IndexEntry::Kind::kGop,
                       .planes_back = std::move(planes_back)});
  if (mesh->fault) return lose_gop({"§4.3", "the mesh of a GOP cannot be used", *mesh->fault});
  if (!is_known_mode(gop_.mode)) return lose_gop(kUnknownMode);
  if (const Fault fault = check_planes(*mesh)) return lose_gop(fault);
  packet_number_ = 1;
  frames_met_ = 0;
  return Event::kGop;
}

namespace {

/// How many of the planes that a GOP of this mesh names are needed.
std::size_t planes_needed(const GopHeader& gop, const ChunkWindow::Entry& mesh) {
  const std::size_t all = gop.plane_count();
  return mesh.parts_wanted == 0 ? all : std::min<std::size_t>(all, mesh.parts_wanted);
}

}  // namespace

/// Whether the planes are in force that the GOP names and that are needed; `back` becomes how far back each
/// is.
// format-spec §4.5.1, §4.9
Fault ChunkReader::find_planes(const ChunkWindow::Entry& mesh, PlaneList& back) {
  std::array<std::uint64_t, GopHeader::kMostPlanes> numbers{};
  const auto named = std::span(numbers).first(gop_.plane_count());
  ByteReader ids(gop_.planes);
  std::size_t needed = planes_needed(gop_, mesh);
  for (std::uint64_t& number : named) {
    const auto* const plan = plans_.find(ids.u32());
    const bool in_force = plan != nullptr && plan->offset >= mesh.offset;
    if (!in_force && needed > 0) return {"§4.5.1", "planes of a GOP are not in force"};
    if (!in_force) whole_ = false;  // how far back they are is not known
    number = in_force ? plans_.back(*plan) : 1;
    if (needed > 0) --needed;
  }
  std::optional<PlaneList> list = PlaneList::of(named);
  if (!list) return {"", "out of memory", ErrorCode::kOutOfMemory};
  back = *std::move(list);
  return {};
}

/// Whether the planes that the GOP needs, all in force, can be used for it.
// format-spec §4.5.1
Fault ChunkReader::check_planes(const ChunkWindow::Entry& mesh) const {
  const std::uint64_t owner = owner_of_planes(gop_.mesh, gop_.mode);
  ByteReader ids(gop_.planes);
  for (std::size_t i = 0; i < planes_needed(gop_, mesh); ++i) {
    const auto* const plan = plans_.find(ids.u32());
    if (plan->number != 0 && plan->number != owner)
      return {"§4.5.1", "planes of a GOP belong to another mesh or mode"};
    if (plan->fault) return {"§4.9", "planes of a GOP cannot be used", *plan->fault};
  }
  return {};
}

/// The GOP whose header was just read cannot be decoded.
// format-spec §8.3
ChunkReader::Event ChunkReader::lose_gop(const Fault& fault) {
  const bool unsupported = fault.code == ErrorCode::kUnsupported;
  const Event event = tell(Event::kGopLost, error_of(fault), chunk_offset_, true, !unsupported);
  if (event != Event::kGopLost) return event;
  if (unsupported) {
    phase_ = Phase::kPassOver;
  } else {
    begin_search(used_);
  }
  return event;
}

/// So many packets were read as the header of the GOP says.
std::optional<ChunkReader::Event> ChunkReader::end_packets() {
  if (!digest_met_) {
    Event event = lose(malformed("§4.5", "a GOP has no digest"), 0);
    problem_.doubts = problem_.loses;
    return event;
  }
  if (payload_left_ > 0) return lose(malformed("§4.5", "bytes follow the packets of a GOP"), 0);
  phase_ = Phase::kGopChecksum;
  return std::nullopt;
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
