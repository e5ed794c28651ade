#include "container/layout.hpp"
#include "gop_decoder.hpp"
#include "mesh_coder.hpp"

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

#include <tvg/decoder.hpp>

namespace tvg {

namespace {

bool known_type(const ChunkType& type) {
  return type == kHeadChunk || type == kMetadataChunk || type == kMeshChunk || type == kGopChunk ||
         type == kIndexChunk || type == kTailChunk;
}

/// The message is short enough for std::string to hold it without an allocation, which would fail too.
Error out_of_memory() {
  return {ErrorCode::kOutOfMemory, "out of memory", {}, {}, ""};
}

}  // namespace

/// The decoding pipeline: bytes → chunks → packets → lattice. Each phase consumes a whole structure or asks
/// for more bytes; each call of step() yields at most one event.
class Decoder::State {
 public:
  explicit State(const DecoderLimits& limits) : caller_limits(limits) {}

  void push(Bytes bytes) {
    if (phase == Phase::kFailed || phase == Phase::kEnded) return;
    if (begin > 0 && begin >= buffer.size() / 2) {  // keep what is unread at the front: no growth over time
      buffer.erase(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(begin));
      begin = 0;
    }
    buffer.insert(buffer.end(), bytes.begin(), bytes.end());
  }

  void jump(std::uint64_t new_offset, std::uint64_t frame) {
    if (phase == Phase::kFailed || !has_head) return;
    buffer.clear();
    begin = 0;
    offset = new_offset;
    phase = Phase::kChunkHeader;
    deferred.reset();
    unreported_loss.reset();
    searched = false;
    position = frame;
    lost_anything = true;  // chunks were passed over: the index cannot be compared with what was seen
    input_finished = false;
  }

  Event poll() {
    if (deferred) return *std::exchange(deferred, std::nullopt);
    for (;;) {
      if (const std::optional<Event> event = step()) return *event;
    }
  }

  Event fail(Error cause) {
    phase = Phase::kFailed;
    error = std::move(cause);
    return Event::kError;
  }

  // What the caller sees.
  StreamHead head;
  Metadata metadata;
  CodedMesh mesh;
  GopDecoder gop;
  GopInfo gop_info;
  std::uint64_t frame_number = 0;
  std::uint64_t frame_bytes = 0;
  std::array<double, 3> frame_bits{};
  ChunkInfo chunk_info;
  Damage damage;
  Error error;
  std::vector<IndexEntry> index;
  bool input_finished = false;
  bool measures_bits = false;

 private:
  enum class Phase {
    kStart,
    kChunkHeader,
    kPayload,
    kSkip,
    kPacket,
    kGopChecksum,
    kResync,
    kTail,
    kEnded,
    kFailed
  };

  std::optional<Event> step();
  std::optional<Event> read_signature();
  std::optional<Event> read_chunk_start();
  std::optional<Event> read_payload();
  std::optional<Event> skip_payload();
  std::optional<Event> read_packet();
  std::optional<Event> begin_gop(Bytes packet, std::size_t total_bytes);
  std::optional<Event> decode_frame(Bytes packet, std::size_t total_bytes);
  std::optional<Event> end_gop();
  std::optional<Event> resynchronize();
  std::optional<Event> end_stream();

  std::optional<Event> use_head(Bytes payload);
  std::optional<Event> use_mesh(Bytes payload);
  std::optional<Event> use_index(Bytes payload);

  Bytes available() const { return Bytes(buffer).subspan(begin); }
  void consume(std::size_t count) {
    begin += count;
    offset += count;
  }
  std::optional<Event> need_bytes();
  Event truncated();
  std::uint64_t frames_left_in_gop() const;
  Event report_loss(std::uint64_t frames, Error cause);
  Event report_doubt(Error cause);
  std::optional<Event> lose_rest(Error cause, std::size_t passed = 1);
  std::optional<Event> lose_unproven(Error cause, std::size_t size);
  void begin_resync(std::size_t passed);

  DecoderLimits caller_limits;
  Phase phase = Phase::kStart;
  std::optional<Event> deferred;
  std::vector<std::uint8_t> buffer;
  std::size_t begin = 0;     ///< first unread byte of the buffer
  std::uint64_t offset = 0;  ///< of that byte in the stream

  bool has_head = false;
  bool has_mesh = false;
  ChunkHeader chunk{};
  std::uint64_t chunk_offset = 0;
  std::uint64_t payload_left = 0;  ///< bytes of the current GOP's or skipped chunk's payload still to come
  Hasher payload_hash;
  std::uint32_t packet_index = 0;  ///< 0: header, 1 to frame_count: frames, then the digest
  std::uint32_t header_checksum = 0;
  std::uint64_t position = 0;            ///< number of the next frame
  std::uint64_t expected_label = 0;      ///< first_frame of the next GOP, if nothing was cut out
  std::optional<Error> unreported_loss;  ///< damage of unknown extent: the next GOP or the index tells
  bool lost_anything = false;
  bool searched = false;                      ///< chunks may have been passed over since the last GOP
  std::uint64_t read_in_vain = 0;             ///< bytes of structures that did not fit their checksums
  std::optional<std::uint64_t> index_offset;  ///< of the index chunk, once it was met
  std::vector<IndexEntry> seen;               ///< what the index should hold
};

std::optional<Decoder::Event> Decoder::State::step() {
  switch (phase) {
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
  if (unreported_loss) return report_loss(0, *std::exchange(unreported_loss, std::nullopt));
  Error cause{ErrorCode::kTruncated,
              "the stream ends before it is complete",
              offset + available().size(),
              {},
              "§3.4"};
  const std::uint64_t frames = frames_left_in_gop();
  fail(cause);
  return frames == 0 ? Event::kError : report_loss(frames, std::move(cause));
}

std::uint64_t Decoder::State::frames_left_in_gop() const {
  const bool inside_gop = phase == Phase::kPacket && packet_index > 0;
  return inside_gop ? gop_info.first_frame + gop_info.frame_count - position : 0;
}

/// Frames are missing, from the next one on.
Decoder::Event Decoder::State::report_loss(std::uint64_t frames, Error cause) {
  lost_anything = true;
  if (!cause.byte_offset) cause.byte_offset = offset;
  cause.frame = position;
  damage = {position, frames, std::move(cause)};
  position += frames;
  return Event::kDamage;
}

/// The frames of the current GOP were given out, but are not what was encoded.
Decoder::Event Decoder::State::report_doubt(Error cause) {
  lost_anything = true;
  cause.byte_offset = chunk_offset;
  cause.frame = gop_info.first_frame;
  damage = {gop_info.first_frame, gop_info.frame_count, std::move(cause)};
  return Event::kDamage;
}

/// The rest of the structure being read is lost: looks for the next chunk. How many frames are gone is known
/// inside a GOP; elsewhere the next GOP or the index will tell. The search begins `passed` bytes on: behind a
/// structure whose checksum fits, since its extent is then known.
std::optional<Decoder::Event> Decoder::State::lose_rest(Error cause, std::size_t passed) {
  if (!has_head) return fail(std::move(cause));
  if (!cause.byte_offset) cause.byte_offset = offset;
  const std::uint64_t frames = frames_left_in_gop();
  begin_resync(passed);
  if (frames > 0) return report_loss(frames, std::move(cause));
  lost_anything = true;
  if (!unreported_loss) unreported_loss = std::move(cause);
  return std::nullopt;
}

/// A structure of `size` bytes does not fit its checksum. The next chunk may begin inside it, where bytes are
/// missing; but a stream may be made so that every byte begins a structure, so that there is a limit to how
/// often its bytes are read again.
std::optional<Decoder::Event> Decoder::State::lose_unproven(Error cause, std::size_t size) {
  constexpr std::uint64_t kAlwaysAllowed = 1u << 24;
  constexpr std::uint64_t kPasses = 8;
  read_in_vain += size;
  const bool too_often = read_in_vain > kAlwaysAllowed + kPasses * offset;
  return lose_rest(std::move(cause), too_often ? size : 1);
}

void Decoder::State::begin_resync(std::size_t passed) {
  phase = Phase::kResync;
  searched = true;
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
  phase = Phase::kChunkHeader;
  return std::nullopt;
}

// format-spec §3.2
std::optional<Decoder::Event> Decoder::State::read_chunk_start() {
  if (available().size() < kChunkHeaderSize) return need_bytes();
  const std::optional<ChunkHeader> header = read_chunk_header(available());
  if (!header) return lose_rest({ErrorCode::kMalformed, "a chunk header is damaged", {}, {}, "§3.2"});
  if (!has_head && header->type != kHeadChunk) {
    return fail({ErrorCode::kMalformed, "the stream does not begin with its head", offset, {}, "§3.4"});
  }
  const bool ancillary = header->type == kMetadataChunk || header->type == kIndexChunk;
  if (known_type(header->type) && header->ancillary != ancillary) {
    return lose_rest(
        {ErrorCode::kMalformed, "a chunk's ancillary flag does not fit its type", {}, {}, "§3.4"});
  }
  chunk = *header;
  chunk_offset = offset;
  payload_hash = Hasher();
  payload_left = chunk.length;
  packet_index = 0;
  consume(kChunkHeaderSize);
  const std::uint64_t mesh_bytes = 64 + 16 * (std::uint64_t{head.limits.vertices} + head.limits.faces);
  if (chunk.type == kGopChunk) {
    phase = Phase::kPacket;
  } else if (chunk.type == kHeadChunk || chunk.type == kTailChunk || chunk.type == kMetadataChunk) {
    phase = Phase::kPayload;
    if (chunk.length > kMaxSmallPayload)
      return lose_rest({ErrorCode::kMalformed, "a chunk is too long", {}, {}, "§3.2"});
  } else if (chunk.type == kMeshChunk) {
    phase = Phase::kPayload;
    has_mesh = false;  // whatever becomes of this mesh, the GOPs that follow are not the last one's
    if (chunk.length > mesh_bytes)
      return lose_rest({ErrorCode::kMalformed, "the mesh is too long", {}, {}, "§4.3"});
  } else if (chunk.type == kIndexChunk) {
    index_offset = chunk_offset;
    phase = chunk.length <= 64 + 20 * seen.size() + 16 * kMaxSmallPayload ? Phase::kPayload : Phase::kSkip;
  } else if (chunk.ancillary) {
    phase = Phase::kSkip;
  } else {
    const std::string type(chunk.type.begin(), chunk.type.end());
    return fail({ErrorCode::kUnsupportedVersion,
                 "the stream needs a decoder that knows chunk '" + type + "'",
                 chunk_offset,
                 {},
                 "§3.2"});
  }
  chunk_info = {std::string(chunk.type.begin(), chunk.type.end()), chunk_offset, chunk.total_size()};
  return Event::kChunk;
}

std::optional<Decoder::Event> Decoder::State::read_payload() {
  const std::size_t size = std::size_t{chunk.length} + kChunkChecksumSize;
  if (available().size() < size) return need_bytes();
  const Bytes payload = available().first(chunk.length);
  const std::uint32_t expected = ByteReader(available().subspan(chunk.length)).u32();
  if (expected != checksum(payload)) {
    return lose_unproven({ErrorCode::kChecksumMismatch,
                          "chunk '" + std::string(chunk.type.begin(), chunk.type.end()) + "' is damaged",
                          chunk_offset,
                          {},
                          "§3.3"},
                         size);
  }
  phase = Phase::kChunkHeader;
  std::optional<Event> event;
  if (chunk.type == kHeadChunk) {
    event = use_head(payload);
  } else if (chunk.type == kMetadataChunk) {
    Result<Metadata> read = read_metadata(payload);
    if (!read) return lose_rest(read.error(), size);
    metadata = std::move(*read);
    event = Event::kMetadata;
  } else if (chunk.type == kMeshChunk) {
    event = use_mesh(payload);
  } else if (chunk.type == kIndexChunk) {
    event = use_index(payload);
  } else {
    const Result<std::uint64_t> distance = read_tail(payload);
    if (!distance) return lose_rest(distance.error(), size);
    phase = Phase::kTail;
    if (!lost_anything && (!index_offset || *distance != chunk_offset - *index_offset)) {
      event = report_loss(
          0, {ErrorCode::kMalformed, "the tail does not lead to the index", chunk_offset, {}, "§4.7"});
    }
  }
  if (phase != Phase::kFailed && phase != Phase::kResync) consume(size);
  return event;
}

std::optional<Decoder::Event> Decoder::State::skip_payload() {
  const std::uint64_t left = payload_left + kChunkChecksumSize;
  const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(left, available().size()));
  consume(count);
  payload_left -= std::min<std::uint64_t>(count, payload_left);
  if (count < left) return need_bytes();
  phase = Phase::kChunkHeader;
  return std::nullopt;
}

// format-spec §4.1, §8.1
std::optional<Decoder::Event> Decoder::State::use_head(Bytes payload) {
  if (has_head)
    return lose_rest({ErrorCode::kMalformed, "the stream has a second head", chunk_offset, {}, "§3.4"},
                     payload.size() + kChunkChecksumSize);
  const Result<StreamHead> read = read_head(payload);
  if (!read) return fail(read.error());
  const StreamLimits& declared = read->limits;
  const auto refuse = [&](const char* what, std::uint64_t asked, std::uint64_t allowed) {
    return fail({ErrorCode::kLimitExceeded,
                 std::string("the stream declares ") + std::to_string(asked) + " " + what +
                     ", the limit set here is " + std::to_string(allowed),
                 chunk_offset,
                 {},
                 "§8.1"});
  };
  if (declared.vertices > caller_limits.vertices)
    return refuse("vertices", declared.vertices, caller_limits.vertices);
  if (declared.faces > caller_limits.faces) return refuse("faces", declared.faces, caller_limits.faces);
  if (declared.frames_per_gop > caller_limits.frames_per_gop) {
    return refuse("frames per GOP", declared.frames_per_gop, caller_limits.frames_per_gop);
  }
  if (declared.packet_bytes > caller_limits.packet_bytes) {
    return refuse("bytes per packet", declared.packet_bytes, caller_limits.packet_bytes);
  }
  if (declared.decoder_memory > caller_limits.memory) {
    return refuse("bytes of decoder memory", declared.decoder_memory, caller_limits.memory);
  }
  head = *read;
  has_head = true;
  return Event::kHead;
}

// format-spec §4.3
std::optional<Decoder::Event> Decoder::State::use_mesh(Bytes payload) {
  Result<CodedMesh> decoded = decode_mesh(payload, head.limits);
  if (!decoded) {
    decoded.error().byte_offset = chunk_offset;
    return lose_rest(decoded.error(), payload.size() + kChunkChecksumSize);
  }
  mesh = std::move(*decoded);
  has_mesh = true;
  seen.push_back({IndexEntry::Kind::kMesh, chunk_offset, 0});
  return Event::kMesh;
}

// format-spec §4.6
std::optional<Decoder::Event> Decoder::State::use_index(Bytes payload) {
  constexpr std::size_t kRoom = 1u << 15;  // entries that the declared memory has room for in any stream
  if (ByteReader(payload).varint() > seen.size() + kRoom) return std::nullopt;
  Result<std::vector<IndexEntry>> read = read_index(payload);
  if (!read) return lose_rest(read.error(), payload.size() + kChunkChecksumSize);
  index = std::move(*read);
  std::uint64_t frames = 0;
  for (const IndexEntry& entry : index) frames += entry.frame_count;
  if (unreported_loss || (searched && frames > position) || (!lost_anything && index != seen)) {
    Error cause = unreported_loss
                      ? *std::exchange(unreported_loss, std::nullopt)
                      : Error{ErrorCode::kMalformed, "the index does not match the stream", {}, {}, "§4.6"};
    return report_loss(frames > position ? frames - position : 0, std::move(cause));
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
      bytes.first(static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), payload_left))));
  const std::uint64_t size = reader.varint();
  if (!reader.ok())
    return bytes.size() < std::min<std::uint64_t>(10, payload_left) ? need_bytes() : lose_rest(damaged());
  const std::size_t prefix = reader.position();
  if (size > head.limits.packet_bytes || size + prefix + kChunkChecksumSize > payload_left)
    return lose_rest(damaged());
  const Bytes packet = reader.bytes(size);
  const std::uint32_t expected = reader.u32();
  if (!reader.ok()) return need_bytes();
  const std::uint64_t seed =
      packet_index == 0 ? 0 : packet_seed(header_checksum, mesh.payload_checksum, packet_index);
  const std::size_t total = prefix + packet.size() + kChunkChecksumSize;
  if (expected != checksum(packet, seed)) return lose_unproven(damaged(), total);

  payload_hash.update(bytes.first(total));  // here, because beginning a GOP may move the buffer
  std::optional<Event> event;
  if (packet_index == 0) {
    header_checksum = expected;
    event = begin_gop(packet, total);
  } else if (packet_index <= gop_info.frame_count) {
    event = decode_frame(packet, total);
  } else if (const Status digest = gop.check_digest(packet); !digest.ok() || payload_left != total) {
    begin_resync(total);
    if (!digest.ok()) return report_doubt(digest.error());
    return report_loss(0, {ErrorCode::kMalformed, "bytes follow a GOP's digest", {}, {}, "§4.5"});
  } else {
    phase = Phase::kGopChecksum;
  }
  if (phase != Phase::kPacket && phase != Phase::kGopChecksum) return event;
  ++packet_index;
  payload_left -= total;
  consume(total);
  return event;
}

std::optional<Decoder::Event> Decoder::State::begin_gop(Bytes packet, std::size_t total_bytes) {
  const Result<GopHeader> header = read_gop_header(packet);
  if (!header) return lose_rest(header.error(), total_bytes);
  std::uint64_t missing = 0;
  if (std::exchange(searched, false) && header->first_frame > expected_label) {
    missing = header->first_frame - expected_label;
    if (!unreported_loss) {
      unreported_loss = Error{ErrorCode::kMalformed, "the damage reaches into the next GOP", {}, {}, "§8.3"};
    }
  }
  expected_label = header->first_frame + header->frame_count;
  if (!has_mesh) {
    Error cause = unreported_loss
                      ? *std::exchange(unreported_loss, std::nullopt)
                      : Error{ErrorCode::kMalformed, "a GOP comes before any mesh", {}, {}, "§3.4"};
    begin_resync(total_bytes);
    return report_loss(missing + header->frame_count, std::move(cause));
  }
  const Status begun = gop.begin(packet, mesh, head.limits);
  if (!begun.ok()) {
    begin_resync(total_bytes);
    unreported_loss.reset();
    return report_loss(missing + header->frame_count, begun.error());
  }
  seen.push_back({IndexEntry::Kind::kGop, chunk_offset, header->frame_count});
  std::optional<Event> event = Event::kGop;
  if (unreported_loss) {
    deferred = event;
    event = report_loss(missing, *std::exchange(unreported_loss, std::nullopt));
  }
  gop_info = gop.info();
  gop_info.first_frame = position;
  gop_info.bytes = chunk.total_size();
  // Room for any packet of this mesh, so that frames do not allocate.
  buffer.reserve(static_cast<std::size_t>(
      std::min<std::uint64_t>(chunk.length, 4096 + 16 * std::uint64_t{mesh.mesh.vertex_count})));
  return event;
}

std::optional<Decoder::Event> Decoder::State::decode_frame(Bytes packet, std::size_t total_bytes) {
  const Status decoded = measures_bits ? gop.decode_frame(packet, frame_bits) : gop.decode_frame(packet);
  if (!decoded.ok()) {  // the checksum fits, so what the packet was decoded from may be wrong already
    position += frames_left_in_gop();
    begin_resync(total_bytes);
    return report_doubt(decoded.error());
  }
  frame_number = position++;
  frame_bytes = total_bytes;
  return Event::kFrame;
}

std::optional<Decoder::Event> Decoder::State::end_gop() {
  if (available().size() < kChunkChecksumSize) return need_bytes();
  const std::uint32_t expected = ByteReader(available()).u32();
  phase = Phase::kChunkHeader;
  consume(kChunkChecksumSize);
  if (expected == static_cast<std::uint32_t>(payload_hash.value())) return std::nullopt;
  return report_loss(0, {ErrorCode::kChecksumMismatch,
                         "the checksum of a GOP is damaged, its frames are not",
                         chunk_offset,
                         {},
                         "§3.3"});
}

// format-spec §8.3
std::optional<Decoder::Event> Decoder::State::resynchronize() {
  while (available().size() >= kChunkHeaderSize) {
    const std::optional<ChunkHeader> header = read_chunk_header(available());
    if (header && header->type != kHeadChunk && known_type(header->type)) {
      phase = Phase::kChunkHeader;
      return std::nullopt;
    }
    consume(1);
  }
  return need_bytes();
}

// format-spec §4.7
std::optional<Decoder::Event> Decoder::State::end_stream() {
  if (unreported_loss) return report_loss(0, *std::exchange(unreported_loss, std::nullopt));
  if (!available().empty()) {
    return fail({ErrorCode::kMalformed, "bytes follow the stream's tail", offset, {}, "§4.7"});
  }
  if (!input_finished) return Event::kNeedBytes;
  phase = Phase::kEnded;
  return Event::kEnd;
}

Decoder::Decoder(const DecoderLimits& limits) : state_(std::make_unique<State>(limits)) {}
Decoder::~Decoder() = default;
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;

void Decoder::push(std::span<const std::uint8_t> bytes) {
  try {
    state_->push(bytes);
  } catch (const std::bad_alloc&) {
    state_->fail(out_of_memory());
  }
}

void Decoder::finish() {
  state_->input_finished = true;
}

Decoder::Event Decoder::poll() {
  try {
    return state_->poll();
  } catch (const std::bad_alloc&) {
    return state_->fail(out_of_memory());
  }
}

const StreamHead& Decoder::head() const {
  return state_->head;
}
const Metadata& Decoder::metadata() const {
  return state_->metadata;
}
const Mesh& Decoder::mesh() const {
  return state_->mesh.mesh;
}
const MeshInfo& Decoder::mesh_info() const {
  return state_->mesh.info;
}
const ChunkInfo& Decoder::chunk() const {
  return state_->chunk_info;
}
const std::array<double, 3>& Decoder::frame_bits() const {
  return state_->frame_bits;
}
void Decoder::jump(std::uint64_t offset, std::uint64_t frame) {
  state_->jump(offset, frame);
}
void Decoder::measure_bits(bool on) {
  state_->measures_bits = on;
}
const GopInfo& Decoder::gop() const {
  return state_->gop_info;
}
std::uint64_t Decoder::frame_number() const {
  return state_->frame_number;
}
std::uint64_t Decoder::frame_bytes() const {
  return state_->frame_bytes;
}
void Decoder::copy_positions(void* positions, std::size_t stride) const {
  state_->gop.copy_positions(positions, stride);
}
void Decoder::copy_lattice(std::span<std::int32_t> indices) const {
  state_->gop.copy_lattice(indices);
}
void Decoder::copy_flags(std::span<std::uint8_t> flags) const {
  state_->gop.copy_flags(flags);
}
const Damage& Decoder::damage() const {
  return state_->damage;
}
const Error& Decoder::error() const {
  return state_->error;
}
const std::vector<IndexEntry>& Decoder::index() const {
  return state_->index;
}

}  // namespace tvg
