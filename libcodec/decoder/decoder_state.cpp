#include "decoder/decoder_state.hpp"

#include <algorithm>

namespace tvg {

namespace {

bool known_type(const ChunkType& type) {
  return type == kHeadChunk || type == kMetadataChunk || type == kMeshChunk || type == kGopChunk ||
         type == kIndexChunk || type == kTailChunk;
}

}  // namespace

std::optional<Decoder::Event> Decoder::State::step() {
  switch (phase_) {
    case Phase::kStart:
      return read_signature();
    case Phase::kChunkHeader:
      return read_chunk_start();
    case Phase::kPayload:
      return read_payload();
    case Phase::kSkip:
      return skip_payload();
    case Phase::kPacket:
      return read_packet();
    case Phase::kGopChecksum:
      return end_gop();
    case Phase::kResync:
      return resynchronize();
    case Phase::kTail:
      return end_stream();
    case Phase::kEnded:
      return Event::kEnd;
    case Phase::kFailed:
      return Event::kError;
  }
  return Event::kError;
}

std::optional<Decoder::Event> Decoder::State::need_bytes() {
  if (!input_finished) return Event::kNeedBytes;
  return truncated();
}

/// The input is over before the stream is: what is missing is reported first, then the end.
Decoder::Event Decoder::State::truncated() {
  if (unreported_loss_) return report_loss(0, *std::exchange(unreported_loss_, std::nullopt));
  Error cause{ErrorCode::kTruncated,
              "the stream ends before it is complete",
              offset_ + available().size(),
              {},
              "§3.4"};
  const std::uint64_t frames = frames_left_in_gop();
  fail(cause);
  return frames == 0 ? Event::kError : report_loss(frames, std::move(cause));
}

std::uint64_t Decoder::State::frames_left_in_gop() const {
  const bool inside_gop = phase_ == Phase::kPacket && packet_index_ > 0;
  return inside_gop ? gop_info.first_frame + gop_info.frame_count - position_ : 0;
}

/// Frames are missing, from the next one on.
Decoder::Event Decoder::State::report_loss(std::uint64_t frames, Error cause) {
  lost_anything_ = true;
  if (!cause.byte_offset) cause.byte_offset = offset_;
  cause.frame = position_;
  damage = {position_, frames, std::move(cause)};
  position_ += frames;
  return Event::kDamage;
}

/// The frames of the current GOP were given out, but are not what was encoded.
Decoder::Event Decoder::State::report_doubt(Error cause) {
  lost_anything_ = true;
  cause.byte_offset = chunk_offset_;
  cause.frame = gop_info.first_frame;
  damage = {gop_info.first_frame, gop_info.frame_count, std::move(cause)};
  return Event::kDamage;
}

/// The rest of the structure being read is lost: looks for the next chunk. How many frames are gone is known
/// inside a GOP; elsewhere the next GOP or the index will tell. The search begins `passed` bytes on: behind a
/// structure whose checksum fits, since its extent is then known.
std::optional<Decoder::Event> Decoder::State::lose_rest(Error cause, std::size_t passed) {
  if (!has_head_) return fail(std::move(cause));
  if (!cause.byte_offset) cause.byte_offset = offset_;
  const std::uint64_t frames = frames_left_in_gop();
  begin_resync(passed);
  if (frames > 0) return report_loss(frames, std::move(cause));
  lost_anything_ = true;
  if (!unreported_loss_) unreported_loss_ = std::move(cause);
  return std::nullopt;
}

/// A structure of `size` bytes does not fit its checksum. The next chunk may begin inside it, where bytes are
/// missing; but a stream may be made so that every byte begins a structure, so that there is a limit to how
/// often its bytes are read again.
std::optional<Decoder::Event> Decoder::State::lose_unproven(Error cause, std::size_t size) {
  constexpr std::uint64_t kAlwaysAllowed = 1u << 24;
  constexpr std::uint64_t kPasses = 8;
  read_in_vain_ += size;
  const bool too_often = read_in_vain_ > kAlwaysAllowed + kPasses * offset_;
  return lose_rest(std::move(cause), too_often ? size : 1);
}

void Decoder::State::begin_resync(std::size_t passed) {
  phase_ = Phase::kResync;
  searched_ = true;
  consume(std::min(passed, available().size()));
}

// format-spec §3.1
std::optional<Decoder::Event> Decoder::State::read_signature() {
  const Bytes bytes = available();
  const std::size_t count = std::min(bytes.size(), kSignature.size());
  if (!std::equal(kSignature.begin(), kSignature.begin() + static_cast<std::ptrdiff_t>(count),
                  bytes.begin())) {
    const bool mangled =
        count == kSignature.size() && std::equal(bytes.begin(), bytes.begin() + 4, kSignature.begin());
    return fail(
        {ErrorCode::kNotTvg,
         mangled ? "a transfer in text mode has changed the stream's line ends: transfer it in binary mode"
                 : "this is not a TVG stream: the signature is missing",
         0,
         {},
         "§3.1"});
  }
  if (count < kSignature.size()) {
    if (input_finished && count == 0)
      return fail({ErrorCode::kTruncated, "the stream is empty", 0, {}, "§3.1"});
    return need_bytes();
  }
  consume(kSignature.size());
  phase_ = Phase::kChunkHeader;
  return std::nullopt;
}

// format-spec §3.2
std::optional<Decoder::Event> Decoder::State::read_chunk_start() {
  if (available().size() < kChunkHeaderSize) return need_bytes();
  const std::optional<ChunkHeader> header = read_chunk_header(available());
  if (!header) return lose_rest({ErrorCode::kMalformed, "a chunk header is damaged", {}, {}, "§3.2"});
  if (!has_head_ && header->type != kHeadChunk) {
    return fail({ErrorCode::kMalformed, "the stream does not begin with its head", offset_, {}, "§3.4"});
  }
  const bool ancillary = header->type == kMetadataChunk || header->type == kIndexChunk;
  if (known_type(header->type) && header->ancillary != ancillary) {
    return lose_rest(
        {ErrorCode::kMalformed, "a chunk's ancillary flag does not fit its type", {}, {}, "§3.4"});
  }
  chunk_ = *header;
  chunk_offset_ = offset_;
  payload_hash_ = Hasher();
  payload_left_ = chunk_.length;
  packet_index_ = 0;
  consume(kChunkHeaderSize);
  const std::uint64_t mesh_bytes = 64 + 16 * (std::uint64_t{head.limits.vertices} + head.limits.faces);
  if (chunk_.type == kGopChunk) {
    phase_ = Phase::kPacket;
  } else if (chunk_.type == kHeadChunk || chunk_.type == kTailChunk || chunk_.type == kMetadataChunk) {
    phase_ = Phase::kPayload;
    if (chunk_.length > kMaxSmallPayload)
      return lose_rest({ErrorCode::kMalformed, "a chunk is too long", {}, {}, "§3.2"});
  } else if (chunk_.type == kMeshChunk) {
    phase_ = Phase::kPayload;
    has_mesh_ = false;  // whatever becomes of this mesh, the GOPs that follow are not the last one's
    if (chunk_.length > mesh_bytes)
      return lose_rest({ErrorCode::kMalformed, "the mesh is too long", {}, {}, "§4.3"});
  } else if (chunk_.type == kIndexChunk) {
    index_offset_ = chunk_offset_;
    phase_ = chunk_.length <= 64 + 20 * map_.size() + 16 * kMaxSmallPayload ? Phase::kPayload : Phase::kSkip;
  } else if (chunk_.ancillary) {
    phase_ = Phase::kSkip;
  } else {
    const std::string type(chunk_.type.begin(), chunk_.type.end());
    return fail({ErrorCode::kUnsupportedVersion,
                 "the stream needs a decoder that knows chunk '" + type + "'",
                 chunk_offset_,
                 {},
                 "§3.2"});
  }
  chunk_info = {std::string(chunk_.type.begin(), chunk_.type.end()), chunk_offset_, chunk_.total_size()};
  return Event::kChunk;
}

std::optional<Decoder::Event> Decoder::State::read_payload() {
  const std::size_t size = std::size_t{chunk_.length} + kChunkChecksumSize;
  if (available().size() < size) return need_bytes();
  const Bytes payload = available().first(chunk_.length);
  const std::uint32_t expected = ByteReader(available().subspan(chunk_.length)).u32();
  if (expected != checksum(payload)) {
    return lose_unproven({ErrorCode::kChecksumMismatch,
                          "chunk '" + std::string(chunk_.type.begin(), chunk_.type.end()) + "' is damaged",
                          chunk_offset_,
                          {},
                          "§3.3"},
                         size);
  }
  phase_ = Phase::kChunkHeader;
  std::optional<Event> event;
  if (chunk_.type == kHeadChunk) {
    event = use_head(payload);
  } else if (chunk_.type == kMetadataChunk) {
    Result<Metadata> read = read_metadata(payload);
    if (!read) return lose_rest(read.error(), size);
    metadata = std::move(*read);
    event = Event::kMetadata;
  } else if (chunk_.type == kMeshChunk) {
    event = use_mesh(payload);
  } else if (chunk_.type == kIndexChunk) {
    event = use_index(payload);
  } else {
    const Result<std::uint64_t> distance = read_tail(payload);
    if (!distance) return lose_rest(distance.error(), size);
    phase_ = Phase::kTail;
    if (!lost_anything_ && (!index_offset_ || *distance != chunk_offset_ - *index_offset_)) {
      event = report_loss(
          0, {ErrorCode::kMalformed, "the tail does not lead to the index", chunk_offset_, {}, "§4.7"});
    }
  }
  if (phase_ != Phase::kFailed && phase_ != Phase::kResync) consume(size);
  return event;
}

std::optional<Decoder::Event> Decoder::State::skip_payload() {
  const std::uint64_t left = payload_left_ + kChunkChecksumSize;
  const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(left, available().size()));
  consume(count);
  payload_left_ -= std::min<std::uint64_t>(count, payload_left_);
  if (count < left) return need_bytes();
  phase_ = Phase::kChunkHeader;
  return std::nullopt;
}

// format-spec §4.1, §8.1
std::optional<Decoder::Event> Decoder::State::use_head(Bytes payload) {
  if (has_head_)
    return lose_rest({ErrorCode::kMalformed, "the stream has a second head", chunk_offset_, {}, "§3.4"},
                     payload.size() + kChunkChecksumSize);
  const Result<StreamHead> read = read_head(payload);
  if (!read) return fail(read.error());
  const StreamLimits& declared = read->limits;
  const auto refuse = [&](const char* what, std::uint64_t asked, std::uint64_t allowed) {
    return fail({ErrorCode::kLimitExceeded,
                 std::string("the stream declares ") + std::to_string(asked) + " " + what +
                     ", the limit set here is " + std::to_string(allowed),
                 chunk_offset_,
                 {},
                 "§8.1"});
  };
  if (declared.vertices > caller_limits_.vertices)
    return refuse("vertices", declared.vertices, caller_limits_.vertices);
  if (declared.faces > caller_limits_.faces) return refuse("faces", declared.faces, caller_limits_.faces);
  if (declared.frames_per_gop > caller_limits_.frames_per_gop) {
    return refuse("frames per GOP", declared.frames_per_gop, caller_limits_.frames_per_gop);
  }
  if (declared.packet_bytes > caller_limits_.packet_bytes) {
    return refuse("bytes per packet", declared.packet_bytes, caller_limits_.packet_bytes);
  }
  if (declared.decoder_memory > caller_limits_.memory) {
    return refuse("bytes of decoder memory", declared.decoder_memory, caller_limits_.memory);
  }
  head = *read;
  has_head_ = true;
  return Event::kHead;
}

// format-spec §4.3
std::optional<Decoder::Event> Decoder::State::use_mesh(Bytes payload) {
  Result<CodedMesh> decoded = decode_mesh(payload, head.limits);
  if (!decoded) {
    decoded.error().byte_offset = chunk_offset_;
    return lose_rest(decoded.error(), payload.size() + kChunkChecksumSize);
  }
  mesh = std::move(*decoded);
  has_mesh_ = true;
  mesh_offset_ = chunk_offset_;
  map_.note({IndexEntry::Kind::kMesh, chunk_offset_, 0}, position_);
  return Event::kMesh;
}

// format-spec §4.6
std::optional<Decoder::Event> Decoder::State::use_index(Bytes payload) {
  constexpr std::size_t kRoom = 1u << 15;  // entries that the declared memory has room for in any stream
  if (ByteReader(payload).varint() > map_.size() + kRoom) return std::nullopt;
  Result<std::vector<IndexEntry>> read = read_index(payload);
  if (!read) return lose_rest(read.error(), payload.size() + kChunkChecksumSize);
  index = std::move(*read);
  std::uint64_t frames = 0;
  for (const IndexEntry& entry : index) frames += entry.frame_count;
  if (unreported_loss_ || (searched_ && frames > position_) || (!lost_anything_ && !map_.matches(index))) {
    Error cause = unreported_loss_
                      ? *std::exchange(unreported_loss_, std::nullopt)
                      : Error{ErrorCode::kMalformed, "the index does not match the stream", {}, {}, "§4.6"};
    return report_loss(frames > position_ ? frames - position_ : 0, std::move(cause));
  }
  return std::nullopt;
}

// format-spec §4.5
std::optional<Decoder::Event> Decoder::State::read_packet() {
  const Bytes bytes = available();
  const auto damaged = [] {
    return Error{ErrorCode::kChecksumMismatch, "a packet is damaged", {}, {}, "§4.5"};
  };
  ByteReader reader(
      bytes.first(static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), payload_left_))));
  const std::uint64_t size = reader.varint();
  if (!reader.ok())
    return bytes.size() < std::min<std::uint64_t>(10, payload_left_) ? need_bytes() : lose_rest(damaged());
  const std::size_t prefix = reader.position();
  if (size > head.limits.packet_bytes || size + prefix + kChunkChecksumSize > payload_left_)
    return lose_rest(damaged());
  const Bytes packet = reader.bytes(size);
  const std::uint32_t expected = reader.u32();
  if (!reader.ok()) return need_bytes();
  const std::uint64_t seed =
      packet_index_ == 0 ? 0 : packet_seed(header_checksum_, mesh.payload_checksum, packet_index_);
  const std::size_t total = prefix + packet.size() + kChunkChecksumSize;
  if (expected != checksum(packet, seed)) return lose_unproven(damaged(), total);

  payload_hash_.update(bytes.first(total));  // here, because beginning a GOP may move the buffer
  std::optional<Event> event;
  if (packet_index_ == 0) {
    header_checksum_ = expected;
    event = begin_gop(packet, total);
  } else if (packet_index_ <= gop_info.frame_count) {
    event = decode_frame(packet, total);
  } else if (const Status digest = gop.check_digest(packet); !digest.ok() || payload_left_ != total) {
    begin_resync(total);
    if (!digest.ok()) return report_doubt(digest.error());
    return report_loss(0, {ErrorCode::kMalformed, "bytes follow a GOP's digest", {}, {}, "§4.5"});
  } else {
    phase_ = Phase::kGopChecksum;
  }
  if (phase_ != Phase::kPacket && phase_ != Phase::kGopChecksum) return event;
  ++packet_index_;
  payload_left_ -= total;
  consume(total);
  return event;
}

/// Frames that damage before this GOP has taken, which is now known: from the place that the index gives the
/// GOP, or from its label.
std::uint64_t Decoder::State::frames_passed_over(const GopHeader& header) {
  if (!std::exchange(searched_, false)) return 0;
  const StreamMap::Place* const place = map_.from_index() ? map_.at(chunk_offset_) : nullptr;
  std::uint64_t missing = 0;
  if (place != nullptr) {
    missing = place->first_frame > position_ ? place->first_frame - position_ : 0;
  } else if (label_known_ && header.first_frame > expected_label_) {
    missing = header.first_frame - expected_label_;
  }
  if (missing > 0 && !unreported_loss_) {
    unreported_loss_ = Error{ErrorCode::kMalformed, "the damage reaches into the next GOP", {}, {}, "§8.3"};
  }
  return missing;
}

std::optional<Decoder::Event> Decoder::State::begin_gop(Bytes packet, std::size_t total_bytes) {
  const Result<GopHeader> header = read_gop_header(packet);
  if (!header) return lose_rest(header.error(), total_bytes);
  const std::uint64_t missing = frames_passed_over(*header);
  expected_label_ = header->first_frame + header->frame_count;
  label_known_ = true;
  if (target_ && position_ + missing + header->frame_count <= *target_) {
    return pass_gop(header->frame_count, missing, total_bytes);
  }
  if (!has_mesh_) {
    Error cause = unreported_loss_
                      ? *std::exchange(unreported_loss_, std::nullopt)
                      : Error{ErrorCode::kMalformed, "a GOP comes before any mesh", {}, {}, "§3.4"};
    begin_resync(total_bytes);
    return report_loss(missing + header->frame_count, std::move(cause));
  }
  const Status begun = header->frame_count <= head.limits.frames_per_gop
                           ? gop.begin(*header, mesh)
                           : Status(Error{ErrorCode::kLimitExceeded,
                                          "the GOP has more frames than the stream's head declares",
                                          {},
                                          {},
                                          "§4.1"});
  if (!begun.ok()) {
    begin_resync(total_bytes);
    unreported_loss_.reset();
    return report_loss(missing + header->frame_count, begun.error());
  }
  std::optional<Event> event = check_place(header->frame_count);
  if (unreported_loss_) event = report_loss(missing, *std::exchange(unreported_loss_, std::nullopt));
  map_.note({IndexEntry::Kind::kGop, chunk_offset_, header->frame_count}, position_);
  if (event) {
    deferred_ = Event::kGop;
  } else {
    event = Event::kGop;
  }
  gop_info = gop.info();
  gop_info.first_frame = position_;
  gop_info.bytes = chunk_.total_size();
  gop_info.header_bytes = packet.size() - header->flags.size();
  // Room for any packet of this mesh, so that frames do not allocate.
  buffer_.reserve(static_cast<std::size_t>(
      std::min<std::uint64_t>(chunk_.length, 4096 + 16 * std::uint64_t{mesh.mesh.vertex_count})));
  return event;
}

std::optional<Decoder::Event> Decoder::State::decode_frame(Bytes packet, std::size_t total_bytes) {
  const Status decoded =
      measured_take != nullptr ? (gop.*measured_take)(packet, frame_bits) : gop.take(packet);
  if (!decoded.ok()) {  // the checksum fits, so what the packet was decoded from may be wrong already
    position_ += frames_left_in_gop();
    begin_resync(total_bytes);
    return report_doubt(decoded.error());
  }
  frame_number = position_++;
  frame_bytes = total_bytes;
  if (target_ && frame_number < *target_) return std::nullopt;
  target_.reset();
  return Event::kFrame;
}

std::optional<Decoder::Event> Decoder::State::end_gop() {
  if (available().size() < kChunkChecksumSize) return need_bytes();
  const std::uint32_t expected = ByteReader(available()).u32();
  phase_ = Phase::kChunkHeader;
  consume(kChunkChecksumSize);
  if (expected == static_cast<std::uint32_t>(payload_hash_.value())) return std::nullopt;
  return report_loss(0, {ErrorCode::kChecksumMismatch,
                         "the checksum of a GOP is damaged, its frames are not",
                         chunk_offset_,
                         {},
                         "§3.3"});
}

// format-spec §8.3
std::optional<Decoder::Event> Decoder::State::resynchronize() {
  while (available().size() >= kChunkHeaderSize) {
    const std::optional<ChunkHeader> header = read_chunk_header(available());
    if (header && header->type != kHeadChunk && known_type(header->type)) {
      phase_ = Phase::kChunkHeader;
      return std::nullopt;
    }
    consume(1);
  }
  return need_bytes();
}

// format-spec §4.7
std::optional<Decoder::Event> Decoder::State::end_stream() {
  if (unreported_loss_) return report_loss(0, *std::exchange(unreported_loss_, std::nullopt));
  if (!available().empty()) {
    return fail({ErrorCode::kMalformed, "bytes follow the stream's tail", offset_, {}, "§4.7"});
  }
  if (!input_finished) return Event::kNeedBytes;
  phase_ = Phase::kEnded;
  return Event::kEnd;
}

}  // namespace tvg
