#include "container/chunk_reader.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"

#include <algorithm>
#include <utility>

namespace tvg {

namespace {

/// What is wrong with a payload of such a chunk that is too long.
OrderRule rule_of_length(ChunkKind kind) {
  constexpr OrderRule::Verdict kPassOver = OrderRule::Verdict::kPassOver;
  constexpr const char* kFault = "the payload of a chunk is too long";
  switch (kind) {
    case ChunkKind::kHead:
      return {kPassOver, kFault, "§4.1"};
    case ChunkKind::kMetadata:
      return {kPassOver, kFault, "§4.2"};
    case ChunkKind::kData:
      return {kPassOver, kFault, "§4.8", ErrorCode::kLimitExceeded};
    case ChunkKind::kMesh:
      return {kPassOver, kFault, "§4.3", ErrorCode::kLimitExceeded};
    case ChunkKind::kPlan:
      return {kPassOver, kFault, "§4.9", ErrorCode::kLimitExceeded};
    case ChunkKind::kIndex:
      return {kPassOver, kFault, "§4.6"};
    default:
      return {kPassOver, kFault, "§4.7"};
  }
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
    case Phase::kPlanes:
      return look_at_planes();
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

ChunkReader::Event ChunkReader::tell(Event event, Error error, std::uint64_t offset, bool loses,
                                     bool searching) {
  if (error.code == ErrorCode::kOutOfMemory || !has_head()) return fail(std::move(error));
  problem_.error = std::move(error);
  if (!problem_.error.byte_offset) problem_.error.byte_offset = offset;
  problem_.loses = loses;
  problem_.searching = searching;
  problem_.doubts = false;
  return event;
}

/// Something is wrong, but nothing is lost by it.
ChunkReader::Event ChunkReader::report(Error error) {
  return tell(Event::kProblem, std::move(error), chunk_offset_, false, phase_ == Phase::kSearch);
}

/// What is being read is lost. The search for the next chunk begins `passed` bytes on.
ChunkReader::Event ChunkReader::lose(Error error, std::size_t passed) {
  if (!error.byte_offset) error.byte_offset = offset_;
  // No frame is behind the index, or behind the digest of a GOP.
  const bool loses = phase_ == Phase::kPacket ? !digest_met_ : in_sequence();
  const Event event = tell(Event::kProblem, std::move(error), offset_, loses, true);
  if (event == Event::kProblem) begin_search(passed);
  return event;
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

void ChunkReader::reject(ErrorCode why) {
  if (kind_ == ChunkKind::kMesh || kind_ == ChunkKind::kPlan) {
    if (auto* const chunk = window_of(kind_).find(payload_checksum_)) chunk->fault = why;
  } else if (phase_ == Phase::kPacket && why == ErrorCode::kUnsupported) {
    phase_ = Phase::kPassOver;
  } else if (phase_ == Phase::kPacket) {
    begin_search(used_);
  }
}

void ChunkReader::pass_over() {
  phase_ = Phase::kPassOver;
  hashed_ = false;
}

std::uint64_t ChunkReader::skip() {
  if (phase_ != Phase::kPassOver || used_ > 0) return 0;
  const std::uint64_t left = payload_left_ + kChunkChecksumSize;
  if (available().size() >= left) return 0;  // next() has not passed over them yet
  const std::uint64_t count = left - available().size();
  consume(available().size());
  offset_ += count;
  phase_ = Phase::kChunkHeader;
  if (unwanted_) whole_ = false;
  return count;
}

void ChunkReader::jump(std::uint64_t new_offset, std::span<const std::uint64_t> kept) {
  buffer_.clear();
  begin_ = used_ = 0;
  content_ = {};
  offset_ = new_offset;
  phase_ = Phase::kChunkHeader;
  state_ = StreamState::kBody;
  meshes_.keep_only(kept);
  plans_.keep_only(kept);
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
    Error error = stream_error(ErrorCode::kTruncated, "§3.4", {"the stream is empty"});
    error.byte_offset = 0;
    return fail(std::move(error));
  }
  consume(count);
  phase_ = Phase::kChunkHeader;
  return std::nullopt;
}

// format-spec §3.2
std::optional<ChunkReader::Event> ChunkReader::read_header() {
  if (available().size() < kChunkHeaderSize) return need_bytes();
  if (!can_allocate(kSmallThings)) return fail(out_of_memory());
  chunk_offset_ = offset_;
  const std::optional<ChunkHeader> header = read_chunk_header(available());
  if (!header) return lose(malformed("§3.2", "a chunk header is damaged"), 1);
  const ChunkKind kind = kind_of(*header);
  const OrderRule rule = rule_for(*header, kind);
  if (rule.verdict != OrderRule::Verdict::kTake && (reported_at_ != offset_ || !has_head())) {
    reported_at_ = offset_;
    return refuse_header(*header, kind, rule);
  }
  return use_header(*header, kind, rule.verdict);
}

/// What becomes of a chunk by its header alone: its place, its flag, its length.
// format-spec §3.4
OrderRule ChunkReader::rule_for(const ChunkHeader& header, ChunkKind kind) const {
  constexpr OrderRule::Verdict kPassOver = OrderRule::Verdict::kPassOver;
  const OrderRule& rule = order_rule(state_, kind);
  if (rule.verdict == OrderRule::Verdict::kRefuse) return rule;
  if (!flag_fits(header, kind)) return {kPassOver, "a chunk's ancillary flag does not fit its type", "§3.2"};
  if (rule.verdict == kPassOver) return rule;
  if (kind < ChunkKind::kAncillary && header.length > most_payload(kind)) return rule_of_length(kind);
  if (kind == ChunkKind::kTail && !whole_) return {};  // that the index is gone is no news then
  return rule;
}

/// Says what is wrong with a chunk by its header alone.
ChunkReader::Event ChunkReader::refuse_header(const ChunkHeader& header, ChunkKind kind,
                                              const OrderRule& rule) {
  Error error = kind == ChunkKind::kCritical && has_head()
                    ? stream_error(rule.code, rule.section, {rule.fault, ": '", text(header.type), "'"})
                    : stream_error(rule.code, rule.section, {rule.fault});
  error.byte_offset = offset_;
  if (rule.verdict == OrderRule::Verdict::kRefuse || !has_head()) return fail(std::move(error));
  const Event event = report(std::move(error));
  if (in_sequence() && (kind == ChunkKind::kMesh || kind == ChunkKind::kPlan || kind == ChunkKind::kGop)) {
    problem_.loses = kind != ChunkKind::kPlan;
    whole_ = false;
  }
  return event;
}

ChunkReader::Event ChunkReader::use_header(const ChunkHeader& header, ChunkKind kind,
                                           OrderRule::Verdict verdict) {
  chunk_ = header;
  kind_ = kind;
  payload_left_ = chunk_.length;
  payload_hash_ = Hasher();
  hashed_ = true;
  packet_number_ = 0;
  digest_met_ = false;
  unwanted_ = false;
  enter_state(header, kind);
  used_ = kChunkHeaderSize;
  if (kind == ChunkKind::kAncillary || verdict == OrderRule::Verdict::kPassOver) {
    phase_ = Phase::kPassOver;
  } else if (kind == ChunkKind::kGop) {
    phase_ = Phase::kPacket;
    if (!reserve_for_packets()) return fail(out_of_memory());
  } else {
    phase_ = kind == ChunkKind::kPlan && leaves_out_ ? Phase::kPlanes : Phase::kPayload;
  }
  return Event::kChunk;
}

/// The state that a chunk leads to, whatever its content is; head and tail change it once they are read.
// format-spec §3.4
void ChunkReader::enter_state(const ChunkHeader& header, ChunkKind kind) {
  if (!in_sequence() || !flag_fits(header, kind)) return;
  if (kind == ChunkKind::kMesh) state_ = StreamState::kBody;
  if (kind == ChunkKind::kIndex) {
    index_offset_ = chunk_offset_;
    state_ = StreamState::kIndexed;
  }
}

/// The longest payload that a chunk of this kind may have here.
std::uint64_t ChunkReader::most_payload(ChunkKind kind) const {
  switch (kind) {
    case ChunkKind::kHead:
      return kMaxHeadPayload;
    case ChunkKind::kData:
      return kMaxDataPayload;
    case ChunkKind::kMesh:
      return head_.limits.mesh_bytes;
    case ChunkKind::kPlan:
      return head_.limits.plan_bytes;
    case ChunkKind::kGop:
      return kMaxChunkLength;
    case ChunkKind::kIndex:
      return most_index_bytes(whole_ ? expected_index_.count() : chunk_offset_ / kLeastChunkSize);
    default:
      return kMaxMetadataPayload;
  }
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
  payload_checksum_ = actual;
  used_ = size;
  content_ = payload;
  phase_ = Phase::kChunkHeader;
  return use_payload(payload);
}

std::optional<ChunkReader::Event> ChunkReader::pass_payload() {
  const Bytes bytes =
      available().first(static_cast<std::size_t>(std::min<std::uint64_t>(payload_left_, available().size())));
  if (hashed_) payload_hash_.update(bytes);
  payload_left_ -= bytes.size();
  consume(bytes.size());
  if (payload_left_ > 0 || available().size() < kChunkChecksumSize) return need_bytes();
  payload_checksum_ = ByteReader(available()).u32();
  consume(kChunkChecksumSize);
  phase_ = Phase::kChunkHeader;
  return hashed_ ? end_payload() : std::nullopt;
}

/// A payload was passed over to its end.
// format-spec §3.3
std::optional<ChunkReader::Event> ChunkReader::end_payload() {
  if (payload_checksum_ != static_cast<std::uint32_t>(payload_hash_.value())) {
    if (kind_ == ChunkKind::kPlan || kind_ == ChunkKind::kMesh) whole_ = false;
    return report(
        stream_error(ErrorCode::kChecksumMismatch, "§3.3", {"chunk '", text(chunk_.type), "' is damaged"}));
  }
  if (!in_sequence() || !flag_fits(chunk_, kind_)) return std::nullopt;
  if (unwanted_)
    return note_plan(owner_of_planes(plan_.mesh, plan_.mode), {}) ? std::nullopt
                                                                  : std::optional(fail(out_of_memory()));
  // Too long to be read, but others go out of force by it.
  const bool noted = kind_ == ChunkKind::kMesh   ? note_mesh(0, ErrorCode::kLimitExceeded)
                     : kind_ == ChunkKind::kPlan ? note_plan(0, ErrorCode::kLimitExceeded)
                                                 : true;
  return noted ? std::nullopt : std::optional(fail(out_of_memory()));
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

// format-spec §3.4
ChunkReader::Event ChunkReader::end_stream() {
  if (!available().empty()) {
    Error error = malformed("§3.4", "bytes follow the stream's tail");
    error.byte_offset = offset_;
    return fail(std::move(error));
  }
  if (!finished_) return Event::kNeedBytes;
  phase_ = Phase::kEnded;
  return Event::kEnd;
}

}  // namespace tvg
