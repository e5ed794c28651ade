#include "container/chunk_reader.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "container/head.hpp"
#include "container/metadata.hpp"
#include "container/packet.hpp"

#include <algorithm>
#include <utility>

namespace tvg {

namespace {

/// The section that bounds the length of such a payload.
const char* section_of_length(ChunkKind kind) {
  if (kind == ChunkKind::kMesh) return "§4.3";
  return kind == ChunkKind::kIndex ? "§4.6" : "§4.2";
}

}  // namespace

bool ChunkReader::push(Bytes bytes) {
  if (over()) return phase_ == Phase::kEnded;
  // What is unread stays at the front: no growth over time.
  const bool full = bytes.size() > buffer_.capacity() - buffer_.size();
  if (begin_ > 0 && (full || begin_ >= buffer_.size() / 2)) {
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
  }
  if (!try_grow(buffer_, bytes.size())) {
    fail(out_of_memory());
    return false;
  }
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  return true;
}

ChunkReader::Event ChunkReader::next() {
  consume(std::exchange(used_, std::size_t{0}));
  content_ = {};
  for (;;) {
    if (const std::optional<Event> event = step()) return *event;
  }
}

std::optional<ChunkReader::Event> ChunkReader::step() {
  switch (phase_) {
    case Phase::kStart:
      return read_signature();
    case Phase::kChunkHeader:
      return read_header();
    case Phase::kPayload:
      return read_payload();
    case Phase::kPassOver:
      return pass_payload();
    case Phase::kPacket:
      return next_packet();
    case Phase::kGopChecksum:
      return end_gop();
    case Phase::kSearch:
      return search();
    case Phase::kTail:
      return end_stream();
    case Phase::kEnded:
      return Event::kEnd;
    case Phase::kFailed:
      return Event::kFailed;
  }
  return Event::kFailed;
}

std::optional<ChunkReader::Event> ChunkReader::need_bytes() {
  if (!finished_) return Event::kNeedBytes;
  Error error = stream_error(ErrorCode::kTruncated, "§3.4", {"the stream ends before it is complete"});
  error.byte_offset = input_offset();
  return fail(std::move(error));
}

ChunkReader::Event ChunkReader::fail(Error error) {
  phase_ = Phase::kFailed;
  used_ = 0;
  error_ = std::move(error);
  return Event::kFailed;
}

/// Something is wrong, but nothing is lost by it.
ChunkReader::Event ChunkReader::report(Error error) {
  if (error.code == ErrorCode::kOutOfMemory) return fail(std::move(error));
  if (!error.byte_offset) error.byte_offset = chunk_offset_;
  problem_ = {std::move(error), false, phase_ == Phase::kSearch};
  return Event::kProblem;
}

/// What is being read is lost. The search for the next chunk begins `passed` bytes on.
ChunkReader::Event ChunkReader::lose(Error error, std::size_t passed) {
  if (error.code == ErrorCode::kOutOfMemory) return fail(std::move(error));
  if (!error.byte_offset) error.byte_offset = offset_;
  if (!has_head()) return fail(std::move(error));
  // No frame is behind the index, unless the order of chunks was broken before.
  problem_ = {std::move(error), state_ == StreamState::kBody || phase_ == Phase::kPacket, true};
  begin_search(passed);
  return Event::kProblem;
}

/// A structure of `size` bytes does not fit its checksum. The next chunk may begin inside it, where bytes are
/// missing; but a stream may be made so that every byte begins a structure, so that there is a limit to how
/// often its bytes are read again.
ChunkReader::Event ChunkReader::lose_unproven(Error error, std::size_t size) {
  constexpr std::uint64_t kAlwaysAllowed = 1u << 24;
  constexpr std::uint64_t kPasses = 8;
  read_in_vain_ += size;
  const bool too_often = read_in_vain_ > kAlwaysAllowed + kPasses * offset_;
  return lose(std::move(error), too_often ? size : 1);
}

void ChunkReader::begin_search(std::size_t passed) {
  phase_ = Phase::kSearch;
  whole_ = false;
  used_ = std::min(passed, available().size());
}

void ChunkReader::reject() {
  if (kind_ == ChunkKind::kMesh) has_mesh_ = false;
  if (phase_ == Phase::kPacket || phase_ == Phase::kGopChecksum) begin_search(used_);
  whole_ = false;
}

void ChunkReader::pass_over() {
  phase_ = Phase::kPassOver;
  hashed_ = false;
  whole_ = false;
}

std::uint64_t ChunkReader::skip() {
  if (phase_ != Phase::kPassOver || used_ > 0) return 0;
  const std::uint64_t left = payload_left_ + kChunkChecksumSize;
  if (available().size() >= left) return 0;  // next() has not passed over them yet
  const std::uint64_t count = left - available().size();
  consume(available().size());
  offset_ += count;
  phase_ = Phase::kChunkHeader;
  whole_ = false;
  return count;
}

void ChunkReader::jump(std::uint64_t new_offset) {
  buffer_.clear();
  begin_ = used_ = 0;
  content_ = {};
  offset_ = new_offset;
  phase_ = Phase::kChunkHeader;
  state_ = StreamState::kBody;
  index_offset_.reset();
  finished_ = false;
  whole_ = false;
}

// format-spec §3.1
std::optional<ChunkReader::Event> ChunkReader::read_signature() {
  const Bytes bytes = available();
  const std::size_t count = std::min(bytes.size(), kSignature.size());
  if (!std::equal(kSignature.begin(), kSignature.begin() + static_cast<std::ptrdiff_t>(count),
                  bytes.begin())) {
    const bool mangled =
        count == kSignature.size() && std::equal(bytes.begin(), bytes.begin() + 4, kSignature.begin());
    Error error = stream_error(
        ErrorCode::kNotTvg, "§3.1",
        {mangled ? "a transfer in text mode has changed the stream's line ends: transfer it in binary mode"
                 : "this is not a TVG stream: the signature is missing"});
    error.byte_offset = 0;
    return fail(std::move(error));
  }
  if (count < kSignature.size()) {
    if (!finished_ || count > 0) return need_bytes();
    Error error = stream_error(ErrorCode::kTruncated, "§3.1", {"the stream is empty"});
    error.byte_offset = 0;
    return fail(std::move(error));
  }
  consume(count);
  phase_ = Phase::kChunkHeader;
  return std::nullopt;
}

// format-spec §3.2, §3.4
std::optional<ChunkReader::Event> ChunkReader::read_header() {
  if (available().size() < kChunkHeaderSize) return need_bytes();
  if (!can_allocate(kSmallThings)) return fail(out_of_memory());
  chunk_offset_ = offset_;
  const std::optional<ChunkHeader> header = read_chunk_header(available());
  if (!header) return lose(malformed("§3.2", "a chunk header is damaged"), 1);
  const ChunkKind kind = kind_of(*header);
  const OrderRule& rule = order_rule(state_, kind);
  if (rule.verdict == OrderRule::Verdict::kRefuse) {
    Error error = kind == ChunkKind::kCritical && has_head()
                      ? stream_error(ErrorCode::kUnsupportedVersion, rule.section,
                                     {rule.fault, ": '", text(header->type), "'"})
                      : malformed(rule.section, rule.fault);
    error.byte_offset = offset_;
    return fail(std::move(error));
  }
  if (kind == ChunkKind::kMesh)
    has_mesh_ = false;  // whatever it is, the GOPs that follow are not the last one's
  if (!flag_fits(*header, kind))
    return lose(malformed("§3.4", "a chunk's ancillary flag does not fit its type"), kChunkHeaderSize);
  // A tail without an index is no news where chunks were lost.
  const bool belongs = rule.verdict == OrderRule::Verdict::kTake || (kind == ChunkKind::kTail && !whole_);
  if (!belongs && reported_at_ != offset_) {
    reported_at_ = offset_;
    return report(malformed(rule.section, rule.fault));
  }
  const bool dispensable = kind == ChunkKind::kMetadata || kind == ChunkKind::kIndex;
  const bool fits =
      kind == ChunkKind::kGop || kind >= ChunkKind::kAncillary || header->length <= most_payload(kind);
  if (!fits && (!dispensable || reported_at_ != offset_)) {
    reported_at_ = offset_;
    Error error = stream_error(ErrorCode::kMalformed, section_of_length(kind),
                               {"chunk '", text(header->type), "' is too long"});
    return dispensable ? report(std::move(error)) : lose(std::move(error), kChunkHeaderSize);
  }
  return use_header(*header, kind, fits ? rule.verdict : OrderRule::Verdict::kPassOver);
}

ChunkReader::Event ChunkReader::use_header(const ChunkHeader& header, ChunkKind kind,
                                           OrderRule::Verdict verdict) {
  chunk_ = header;
  kind_ = kind;
  payload_left_ = chunk_.length;
  payload_hash_ = Hasher();
  hashed_ = true;
  packet_index_ = 0;
  if (kind == ChunkKind::kAncillary || verdict == OrderRule::Verdict::kPassOver) {
    phase_ = Phase::kPassOver;
  } else if (kind == ChunkKind::kGop) {
    phase_ = Phase::kPacket;
    if (!reserve_for_packets()) return fail(out_of_memory());
  } else {
    phase_ = Phase::kPayload;
  }
  // Head and tail change the state once they are read.
  if (kind == ChunkKind::kIndex && state_ == StreamState::kBody) {
    index_offset_ = chunk_offset_;
    state_ = StreamState::kIndex;
  }
  used_ = kChunkHeaderSize;
  return Event::kChunk;
}

/// The longest payload that a chunk of this kind may have here.
std::uint64_t ChunkReader::most_payload(ChunkKind kind) const {
  if (kind == ChunkKind::kMesh) return most_mesh_bytes(head_.limits);
  if (kind == ChunkKind::kIndex) return most_index_bytes(chunk_offset_);
  return kMaxSmallPayload;
}

/// Room for any packet of this mesh, so that frames do not allocate.
bool ChunkReader::reserve_for_packets() {
  constexpr std::uint64_t kAnyHeader = 4096;
  constexpr std::uint64_t kBytesPerVertex = 16;
  const std::uint64_t vertices = has_mesh_ ? mesh_.vertex_count : 0;
  return try_reserve(buffer_, static_cast<std::size_t>(std::min<std::uint64_t>(
                                  chunk_.length, kAnyHeader + kBytesPerVertex * vertices)));
}

// format-spec §3.3
std::optional<ChunkReader::Event> ChunkReader::read_payload() {
  const std::size_t size = std::size_t{chunk_.length} + kChunkChecksumSize;
  if (available().size() < size) return need_bytes();
  const Bytes payload = available().first(chunk_.length);
  const std::uint32_t expected = ByteReader(available().subspan(chunk_.length)).u32();
  const std::uint32_t actual = checksum(payload);
  if (expected != actual) {
    Error error =
        stream_error(ErrorCode::kChecksumMismatch, "§3.3", {"chunk '", text(chunk_.type), "' is damaged"});
    error.byte_offset = chunk_offset_;
    return lose_unproven(std::move(error), size);
  }
  if (kind_ == ChunkKind::kMesh) mesh_checksum_ = actual;
  used_ = size;
  content_ = payload;
  phase_ = Phase::kChunkHeader;
  return use_payload(payload);
}

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

std::optional<ChunkReader::Event> ChunkReader::pass_payload() {
  const Bytes bytes =
      available().first(static_cast<std::size_t>(std::min<std::uint64_t>(payload_left_, available().size())));
  if (hashed_) payload_hash_.update(bytes);
  payload_left_ -= bytes.size();
  consume(bytes.size());
  if (payload_left_ > 0 || available().size() < kChunkChecksumSize) return need_bytes();
  const std::uint32_t expected = ByteReader(available()).u32();
  consume(kChunkChecksumSize);
  phase_ = Phase::kChunkHeader;
  if (!hashed_ || expected == static_cast<std::uint32_t>(payload_hash_.value())) return std::nullopt;
  return report(
      stream_error(ErrorCode::kChecksumMismatch, "§3.3", {"chunk '", text(chunk_.type), "' is damaged"}));
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

// format-spec §8.3
std::optional<ChunkReader::Event> ChunkReader::search() {
  for (; available().size() >= kChunkHeaderSize; consume(1)) {
    const std::optional<ChunkHeader> header = read_chunk_header(available());
    if (!header) continue;
    const ChunkKind kind = kind_of(*header);
    if (kind == ChunkKind::kHead || kind >= ChunkKind::kAncillary) continue;
    phase_ = Phase::kChunkHeader;
    return std::nullopt;
  }
  return need_bytes();
}

// format-spec §4.7
ChunkReader::Event ChunkReader::end_stream() {
  if (!available().empty()) {
    Error error = malformed("§4.7", "bytes follow the stream's tail");
    error.byte_offset = offset_;
    return fail(std::move(error));
  }
  if (!finished_) return Event::kNeedBytes;
  phase_ = Phase::kEnded;
  return Event::kEnd;
}

}  // namespace tvg
