#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "decoder/decoder_state.hpp"

#include <array>
#include <optional>
#include <span>
#include <utility>

// The decoding pipeline: bytes → structures (ChunkReader) → mesh, GOP, frames (decode_mesh, GopDecoder) →
// events.
namespace tvg {

Decoder::Event Decoder::State::poll() {
  for (;;) {
    for (std::optional<Event>& event : deferred_) {
      if (event) return *std::exchange(event, std::nullopt);
    }
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
    case ChunkReader::Event::kData:
      return Event::kData;
    case ChunkReader::Event::kMesh:
      return take_mesh();
    case ChunkReader::Event::kPlan:
      return take_plan();
    case ChunkReader::Event::kGop:
      return begin_gop();
    case ChunkReader::Event::kGopLost:
      return lose_gop();
    case ChunkReader::Event::kFrame:
      return decode_frame();
    case ChunkReader::Event::kDigest:
      return end_gop();
    case ChunkReader::Event::kPacket:
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
  if (Status decoded = decode_mesh_read(); !decoded.ok()) {
    Error cause = decoded.error();
    cause.byte_offset = reader.chunk_offset();
    if (cause.code == ErrorCode::kOutOfMemory) {
      reader.fail(std::move(cause));
    } else {
      reader.reject(cause.code);
      frames_.lose_unknown(std::move(cause));
    }
    return std::nullopt;
  }
  if (!map_.note({{.offset = reader.chunk_offset(), .kind = IndexEntry::Kind::kMesh}, frames_.position()})) {
    reader.fail(out_of_memory());
    return std::nullopt;
  }
  return show(mesh_in_force(reader.mesh_id())) ? std::optional(Event::kMesh) : std::nullopt;
}

/// Decodes the mesh whose chunk was just read, unless it is in force already.
Status Decoder::State::decode_mesh_read() {
  if (mesh_in_force(reader.mesh_id()) != nullptr) return {};
  Result<GopMesh> decoded = decode_gop_mesh(reader.mesh(), reader.mesh_id(), reader.head().limits, lod);
  if (!decoded) return decoded.error();
  if (!can_allocate(kSmallThings)) return out_of_memory();
  if (decoded->coded.info.lod > 0)
    reader.want_parts(static_cast<std::uint32_t>(decoded->coded.parts_wanted()));
  reader.keep(std::make_shared<const GopMesh>(std::move(*decoded)));
  return {};
}

/// A mesh as it was decoded; null where none of this name is in force.
std::shared_ptr<const GopMesh> Decoder::State::mesh_in_force(std::uint32_t id) const {
  const ChunkWindow::Entry* const entry = reader.meshes().find(id);
  return entry == nullptr ? nullptr : std::static_pointer_cast<const GopMesh>(entry->content);
}

/// Makes a mesh that of the frames to come; false where it is already.
bool Decoder::State::show(std::shared_ptr<const GopMesh> next) {
  if (next == mesh) return false;
  mesh = std::move(next);
  return true;
}

// format-spec §4.5
std::optional<Decoder::Event> Decoder::State::begin_gop() {
  const GopHeader& header = reader.gop();
  const std::uint64_t missing = frames_.meet_gop(header.first_frame, header.frame_count, indexed_place());
  if (is_on_the_way(missing)) return pass_gop(missing);
  const std::shared_ptr<const GopMesh> its_mesh = mesh_in_force(header.mesh);
  if (Status begun = gop.begin(header, its_mesh, plan_of_gop()); !begun.ok())
    return reject_gop(missing, begun.error());
  const bool another_mesh = show(its_mesh);
  std::optional<Event> told = check_place();
  if (frames_.has_unknown()) told = tell(frames_.lose(missing, frames_.take_cause({})));
  note_gop();
  gop_end_ = frames_.position() + header.frame_count;
  gop_info = gop.info();
  gop_info.first_frame = frames_.position();
  gop_info.bytes = reader.chunk().total_size();
  gop_info.header_bytes = reader.content().size() - gop_info.flag_bytes;
  deferred_ = {another_mesh ? std::optional(Event::kMesh) : std::nullopt, Event::kGop};
  return told;
}

/// A GOP with these frames missing before it cannot be decoded, though its header packet is whole.
Decoder::Event Decoder::State::reject_gop(std::uint64_t missing, Error cause) {
  const std::uint32_t frame_count = reader.gop().frame_count;
  cause.byte_offset = reader.offset();
  reader.reject(cause.code);
  if (cause.code == ErrorCode::kOutOfMemory) {
    reader.fail(std::move(cause));
    return Event::kError;
  }
  if (cause.code != ErrorCode::kUnsupported) frames_.search();
  note_gop();
  frames_.take_cause({});
  return tell(frames_.lose(missing + frame_count, std::move(cause)));
}

/// Takes note of where the GOP lies whose header was just read.
void Decoder::State::note_gop() {
  const GopHeader& header = reader.gop();
  StreamMap::Place place{{.offset = reader.chunk_offset(), .frame_count = header.frame_count},
                         frames_.position()};
  if (const auto* const in_force = reader.meshes().find(header.mesh)) place.mesh_offset = in_force->offset;
  std::array<std::uint64_t, GopHeader::kMostPlanes> plan_offsets{};
  std::size_t known = 0;
  const std::shared_ptr<const GopMesh> its_mesh = mesh_in_force(header.mesh);
  const std::size_t left_out = its_mesh == nullptr ? 0 : its_mesh->coded.info.lod;
  ByteReader ids(header.planes);
  for (std::size_t i = 0; i + std::min(left_out, header.plane_count()) < header.plane_count(); ++i) {
    const auto* const in_force = reader.plans().find(ids.u32());
    if (in_force != nullptr) plan_offsets[known++] = in_force->offset;
  }
  const std::optional<PlaneList> plans = PlaneList::of(std::span(plan_offsets).first(known));
  if (plans) place.plan_offsets = *plans;
  if (!plans || !map_.note(place)) reader.fail(out_of_memory());
}

std::optional<Decoder::Event> Decoder::State::decode_frame() {
  const Bytes packet = reader.content();
  const Predictor predictor = reader.predictor();
  Status decoded = measured_take != nullptr ? (gop.*measured_take)(packet, predictor, frame_bits)
                                            : gop.take(packet, predictor);
  if (!decoded.ok() && decoded.error().code == ErrorCode::kOutOfMemory) {
    reader.fail(decoded.error());
    return Event::kError;
  }
  if (!decoded.ok()) {  // the checksum fits, so what the packet was decoded from may be wrong already
    reader.reject(decoded.error().code);
    frames_.search();
    return doubt_gop(decoded.error());
  }
  frame_predictor = predictor;
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
  if (problem.doubts) return doubt_gop(std::move(problem.error));
  if (frames_left() > 0) return tell(frames_.lose(frames_left(), std::move(problem.error)));
  frames_.lose_unknown(std::move(problem.error));
  return std::nullopt;
}

/// A GOP that the reader does not take apart: its mesh is not in force, or more is needed than is known here.
std::optional<Decoder::Event> Decoder::State::lose_gop() {
  const GopHeader& header = reader.gop();
  const std::uint64_t missing = frames_.meet_gop(header.first_frame, header.frame_count, indexed_place());
  if (is_on_the_way(missing)) return pass_gop(missing);  // its mesh was passed over, perhaps
  note_gop();
  ChunkReader::Problem& problem = reader.problem();
  if (problem.searching) frames_.search();
  return tell(frames_.lose(missing + header.frame_count, frames_.take_cause(std::move(problem.error))));
}

/// The frames of the current GOP were given out, or were about to be, but are not what was encoded.
Decoder::Event Decoder::State::doubt_gop(Error cause) {
  frames_.advance(frames_left());
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
const CodedData& Decoder::data() const {
  return state_->reader.data();
}
const Mesh& Decoder::mesh() const {
  return state_->mesh->coded.drawn();
}
const MeshInfo& Decoder::mesh_info() const {
  return state_->mesh->coded.info;
}
const MeshProperties& Decoder::properties() const {
  return state_->mesh->properties;
}
std::span<const float> Decoder::animated_values(std::size_t attribute) const {
  return state_->gop.animated().values(attribute);
}
std::uint64_t Decoder::animated_bytes(std::size_t attribute) const {
  return state_->gop.animated().bytes(attribute);
}
std::uint32_t Decoder::lod_count() const {
  return static_cast<std::uint32_t>(mesh_info().lods.size());
}
std::span<const std::uint32_t> Decoder::lod_vertices() const {
  return state_->mesh->coded.cut.numbers;
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
void Decoder::use_components(std::uint32_t most) {
  state_->most_components = most;
}
void Decoder::use_lod(std::uint32_t lod) {
  state_->lod = lod;
}
const GopInfo& Decoder::gop() const {
  return state_->gop_info;
}
std::uint64_t Decoder::frame_number() const {
  return state_->frame_number;
}
Predictor Decoder::frame_predictor() const {
  return state_->frame_predictor;
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
BasisInfo Decoder::basis() const {
  const BasisDecoder* const basis = state_->gop.basis();
  return basis == nullptr ? BasisInfo() : basis->basis();
}
void Decoder::copy_planes(std::size_t group, std::span<float> values) const {
  state_->gop.basis()->copy_planes(group, values);
}
void Decoder::copy_planes(std::size_t group, std::span<std::int16_t> values) const {
  state_->gop.basis()->copy_planes(group, values);
}
void Decoder::copy_rows(std::span<float> rows) const {
  state_->gop.basis()->copy_rows(rows);
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
