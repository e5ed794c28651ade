#include "decoder/decoder_state.hpp"

#include <new>

#include <tvg/decoder.hpp>

namespace tvg {

namespace {

/// The message is short enough for std::string to hold it without an allocation, which would fail too.
Error out_of_memory() {
  return {ErrorCode::kOutOfMemory, "out of memory", {}, {}, ""};
}

}  // namespace

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
void Decoder::set_index(const std::vector<IndexEntry>& entries) {
  try {
    state_->set_index(entries);
  } catch (const std::bad_alloc&) {
    state_->fail(out_of_memory());
  }
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
  return state_->error;
}
const std::vector<IndexEntry>& Decoder::index() const {
  return state_->index;
}

}  // namespace tvg
