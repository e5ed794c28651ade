#include "modes/gop_decoder.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "entropy/range_coder.hpp"
#include "quantization/flag_coder.hpp"

#include <algorithm>
#include <cstring>

namespace tvg {

// format-spec §7.4
Status GopDecoder::begin(const GopHeader& header, const CodedMesh& mesh) {
  const std::size_t vertex_count = mesh.gates.size();
  // Three planes and the flags, and the models, whose size does not depend on the mesh.
  constexpr std::size_t kModelBytes = std::size_t{1} << 19;
  if (!can_allocate(vertex_count * (3 * sizeof(Quad) + 1) + kModelBytes)) return out_of_memory();
  mesh_ = &mesh;
  lattice_ = {header.origin, header.step, header.fine_bits, header.coarse_bits};
  info_ = {};
  info_.first_frame = info_.source_frame = header.first_frame;
  info_.frame_count = header.frame_count;
  info_.predictor = static_cast<Predictor>(header.predictor);
  info_.fine_bits = header.fine_bits;
  info_.coarse_bits = header.coarse_bits;
  info_.origin = header.origin;
  info_.step = header.step;
  info_.flagged = static_cast<std::uint32_t>(vertex_count);
  info_.flag_bytes = header.flags.size();
  flags_.clear();
  if (lattice_.hybrid()) {
    flags_.resize(vertex_count);
    RangeDecoder coder(header.flags);
    code_flags(coder, mesh.gates, flags_);
    if (!coder.finished()) return malformed("§7.4", "the importance flags do not fill their bytes exactly");
    info_.flagged = static_cast<std::uint32_t>(std::count(flags_.begin(), flags_.end(), 1));
  }
  coder_.emplace(mesh.gates, flags_, lattice_, info_.predictor);
  digest_ = Hasher();
  return {};
}

// format-spec §7.5
template <class Coder>
Status GopDecoder::decode_residuals(Coder& coder) {
  coder_->next_frame();
  const bool inside = coder_->code(coder);
  if (!coder.finished()) return malformed("§6.1", "the frame's residuals do not fill its packet exactly");
  if (!inside) return malformed("§7.5", "a decoded index lies outside its lattice");
  digest_.update(
      std::span<const std::int32_t>(coder_->indices().front().data(), 4 * coder_->indices().size()));
  return {};
}

Status GopDecoder::decode_frame(Bytes packet) {
  RangeDecoder coder(packet);
  return decode_residuals(coder);
}

Status GopDecoder::decode_frame(Bytes packet, std::array<double, 3>& bits) {
  MeteredRangeDecoder coder(packet);
  Status status = decode_residuals(coder);
  bits = coder.bits();
  return status;
}

// format-spec §7.6
Status GopDecoder::check_digest(Bytes packet) const {
  ByteReader reader(packet);
  const std::uint64_t expected = reader.u64();
  if (!reader.finished()) return malformed("§4.5", "the GOP's digest has a wrong size");
  if (expected == digest_.value()) return {};
  return stream_error(ErrorCode::kDigestMismatch, "§7.6",
                      {"the GOP decoded to other values than were encoded"});
}

void GopDecoder::copy_positions(void* positions, std::size_t stride) const {
  const std::span<const Quad> indices = coder_->indices();
  const int shift = lattice_.shift();
  const double coarse_step = lattice_.step * static_cast<double>(std::uint32_t{1} << shift);
  auto* const target = static_cast<std::byte*>(positions);
  for (std::size_t v = 0; v < indices.size(); ++v) {
    const bool fine = flagged(v);
    const double step = fine ? lattice_.step : coarse_step;
    std::array<float, 3> position;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t index = shift_to_coarse(indices[v][axis], fine ? 0 : shift);
      position[axis] = reconstruct(index, lattice_.origin[axis], step);
    }
    std::memcpy(target + stride * mesh_->order[v], position.data(), sizeof position);
  }
}

void GopDecoder::copy_lattice(std::span<std::int32_t> target) const {
  const std::span<const Quad> indices = coder_->indices();
  for (std::size_t v = 0; v < indices.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      target[3 * std::size_t{mesh_->order[v]} + axis] =
          shift_to_coarse(indices[v][axis], flagged(v) ? 0 : lattice_.shift());
    }
  }
}

void GopDecoder::copy_flags(std::span<std::uint8_t> target) const {
  for (std::size_t v = 0; v < mesh_->order.size(); ++v) target[mesh_->order[v]] = flagged(v) ? 1 : 0;
}

}  // namespace tvg
