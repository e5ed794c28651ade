#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "decoder/decoder_state.hpp"

#include <utility>

// The decoding pipeline: bytes → structures (ChunkReader) → mesh, GOP, frames (decode_mesh, GopDecoder) →
// events.
namespace tvg {

Decoder::Event Decoder::State::poll() {
  if (deferred_) return *std::exchange(deferred_, std::nullopt);
  for (;;) {
    if (const std::optional<Event> event = step()) return *event;
  }
}

std::optional<Decoder::Event> Decoder::State::step() {
  switch (reader.next()) {
    case ChunkReader::Event::kNeedBytes:
      return Event::kNeedBytes;
    case ChunkReader::Event::kChunk:
      return take_chunk();
    case ChunkReader::Event::kHead:
      return Event::kHead;
    case ChunkReader::Event::kMetadata:
      metadata = reader.take_metadata();
      return Event::kMetadata;
    case ChunkReader::Event::kMesh:
      return take_mesh();
    case ChunkReader::Event::kGop:
      return begin_gop();
    case ChunkReader::Event::kOrphan:
      return lose_orphan();
    case ChunkReader::Event::kFrame:
      return decode_frame();
    case ChunkReader::Event::kDigest:
      return end_gop();
    case ChunkReader::Event::kGopEnd:
      return std::nullopt;
    case ChunkReader::Event::kIndex:
      return take_index();
    case ChunkReader::Event::kProblem:
      return take_problem();
    case ChunkReader::Event::kEnd:
      return end_stream();
    case ChunkReader::Event::kFailed:
      break;
  }
  return fail();
}

Decoder::Event Decoder::State::take_chunk() {
  const ChunkHeader& chunk = reader.chunk();
  chunk_info.type.assign(text(chunk.type));
  chunk_info.offset = reader.chunk_offset();
  chunk_info.bytes = chunk.total_size();
  return Event::kChunk;
}

// format-spec §4.3
std::optional<Decoder::Event> Decoder::State::take_mesh() {
  Result<CodedMesh> decoded = decode_mesh(reader.mesh(), reader.mesh_checksum());
  if (!decoded) {
    Error& cause = decoded.error();
    cause.byte_offset = reader.chunk_offset();
    reader.reject();
    if (cause.code == ErrorCode::kOutOfMemory) {
      reader.fail(std::move(cause));
    } else {
      frames_.lose_unknown(std::move(cause));
    }
    return std::nullopt;
  }
  mesh = std::move(*decoded);
  if (!map_.note({IndexEntry::Kind::kMesh, reader.chunk_offset(), 0}, frames_.position()))
    reader.fail(out_of_memory());
  return Event::kMesh;
}

// format-spec §4.5
std::optional<Decoder::Event> Decoder::State::begin_gop() {
  const GopHeader& header = reader.gop();
  const std::uint64_t missing = frames_.meet_gop(header.first_frame, header.frame_count, indexed_place());
  if (target_ && frames_.position() + missing + header.frame_count <= *target_) return pass_gop(missing);
  if (Status begun = gop.begin(header, mesh); !begun.ok()) {
    Error cause = begun.error();
    cause.byte_offset = reader.offset();
    if (cause.code == ErrorCode::kOutOfMemory) {
      reader.fail(std::move(cause));
      return std::nullopt;
    }
    reader.reject();
    frames_.search();
    frames_.take_cause({});
    return tell(frames_.lose(missing + header.frame_count, std::move(cause)));
  }
  std::optional<Event> event = check_place();
  if (frames_.has_unknown()) event = tell(frames_.lose(missing, frames_.take_cause({})));
  if (!map_.note({IndexEntry::Kind::kGop, reader.chunk_offset(), header.frame_count}, frames_.position()))
    reader.fail(out_of_memory());
  gop_end_ = frames_.position() + header.frame_count;
  gop_info = gop.info();
  gop_info.first_frame = frames_.position();
  gop_info.bytes = reader.chunk().total_size();
  gop_info.header_bytes = reader.content().size() - header.flags.size();
  if (event) deferred_ = Event::kGop;
  return event ? event : Event::kGop;
}

std::optional<Decoder::Event> Decoder::State::decode_frame() {
  const Bytes packet = reader.content();
  Status decoded = measured_take != nullptr ? (gop.*measured_take)(packet, frame_bits) : gop.take(packet);
  if (!decoded.ok()) {  // the checksum fits, so what the packet was decoded from may be wrong already
    frames_.advance(frames_left());
    reader.reject();
    frames_.search();
    return doubt_gop(decoded.error());
  }
  frame_number = frames_.position();
  frame_bytes = reader.raw().size();
  frames_.advance(1);
  if (target_ && frame_number < *target_) return std::nullopt;
  target_.reset();
  return Event::kFrame;
}

// format-spec §7.6
std::optional<Decoder::Event> Decoder::State::end_gop() {
  const Status digest = gop.check_digest(reader.content());
  if (digest.ok()) {
    gop_end_ = 0;
    return std::nullopt;
  }
  return doubt_gop(digest.error());
}

// format-spec §4.6
std::optional<Decoder::Event> Decoder::State::take_index() {
  index = reader.take_index();
  const std::uint64_t missing = frames_.meet_index(count_frames(index));
  const bool matches = map_.from_index() ? map_.matches(index) : reader.index_matches();
  if (matches && !frames_.has_unknown() && !(frames_.searched() && missing > 0)) return std::nullopt;
  Error mismatch = malformed("§4.6", "the index does not match the stream");
  mismatch.byte_offset = reader.chunk_offset();
  return tell(frames_.lose(missing, frames_.take_cause(std::move(mismatch))));
}

// format-spec §8.3
std::optional<Decoder::Event> Decoder::State::take_problem() {
  ChunkReader::Problem& problem = reader.problem();
  if (problem.searching) frames_.search();
  if (!problem.loses) return tell(frames_.lose(0, std::move(problem.error)));
  if (frames_left() > 0) return tell(frames_.lose(frames_left(), std::move(problem.error)));
  frames_.lose_unknown(std::move(problem.error));
  return std::nullopt;
}

/// A GOP whose mesh is lost, or never was there.
Decoder::Event Decoder::State::lose_orphan() {
  const GopHeader& header = reader.gop();
  const std::uint64_t missing = frames_.meet_gop(header.first_frame, header.frame_count, indexed_place());
  frames_.search();
  return tell(frames_.lose(missing + header.frame_count,
                           frames_.take_cause(malformed("§3.4", "a GOP comes before any mesh"))));
}

/// The frames of the current GOP were given out, or were about to be, but are not what was encoded.
Decoder::Event Decoder::State::doubt_gop(Error cause) {
  cause.byte_offset = reader.chunk_offset();
  return tell(DamageLedger::doubt(gop_info.first_frame, gop_info.frame_count, std::move(cause)));
}

Decoder::Event Decoder::State::tell(Damage what) {
  damage = std::move(what);
  if (!damage.error.byte_offset) damage.error.byte_offset = reader.offset();
  return Event::kDamage;
}

Decoder::Event Decoder::State::end_stream() {
  return frames_.has_unknown() ? tell(frames_.settle_unknown()) : Event::kEnd;
}

/// The stream cannot be read on; what is missing of it is told first.
Decoder::Event Decoder::State::fail() {
  const bool truncated = reader.error().code == ErrorCode::kTruncated && can_allocate(kSmallThings);
  if (truncated && frames_.has_unknown()) return tell(frames_.settle_unknown());
  if (truncated && frames_left() > 0) return tell(frames_.lose(frames_left(), reader.error()));
  return Event::kError;
}

// --- the public interface ---

Decoder::Decoder(const DecoderLimits& limits) : state_(std::make_unique<State>(limits)) {}
Decoder::~Decoder() = default;
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;

void Decoder::push(std::span<const std::uint8_t> bytes) {
  state_->reader.push(bytes);  // a failure is what poll() then gives
}
void Decoder::finish() {
  state_->reader.finish();
}
Decoder::Event Decoder::poll() {
  return state_->poll();
}
const StreamHead& Decoder::head() const {
  return state_->reader.head();
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
void Decoder::set_index(const std::vector<IndexEntry>& entries) {
  state_->set_index(entries);
}
Result<std::uint64_t> Decoder::seek(std::uint64_t frame) {
  return state_->seek(frame);
}
std::uint64_t Decoder::skip() {
  return state_->skip();
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
  return state_->reader.error();
}
const std::vector<IndexEntry>& Decoder::index() const {
  return state_->index;
}

}  // namespace tvg
