#include "modes/elp_decode.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "entropy/range_coder.hpp"
#include "modes/elp_take.hpp"
#include "quantization/flag_coder.hpp"

#include <algorithm>
#include <cstring>

namespace tvg {

// format-spec §7.4
Status ElpDecoder::begin(const GopHeader& header, const CodedMesh& mesh) {
  const std::size_t vertex_count = mesh.gates.size();
  if (!can_allocate(vertex_count * (PositionCoder::kBytesPerVertex + 1) + PositionCoder::kMostModelBytes))
    return out_of_memory();
  mesh_ = &mesh;
  lattice_ = {.origin = header.origin,
              .step = header.step,
              .fine_bits = header.fine_bits,
              .coarse_bits = header.coarse_bits};
  info_ = {.first_frame = header.first_frame,
           .source_frame = header.first_frame,
           .frame_count = header.frame_count,
           .predictor = static_cast<Predictor>(header.predictor),
           .fine_bits = header.fine_bits,
           .coarse_bits = header.coarse_bits,
           .origin = header.origin,
           .step = header.step,
           .flagged = static_cast<std::uint32_t>(vertex_count),
           .flag_bytes = header.flags.size()};
  flags_.clear();
  if (lattice_.hybrid()) {
    flags_.resize(vertex_count);
    RangeDecoder coder(header.flags);
    code_flags(coder, mesh.gates, flags_);
    if (!coder.finished()) return malformed("§7.4", "the importance flags do not fill their bytes exactly");
    info_.flagged = static_cast<std::uint32_t>(std::count(flags_.begin(), flags_.end(), 1));
  }
  positions_.emplace(Schedule(mesh.gates), flags_, lattice_);
  frames_taken_ = 0;
  digest_ = Hasher();
  return {};
}

Status ElpDecoder::take(Bytes packet) {
  RangeDecoder coder(packet);
  return decode(coder);
}

void ElpDecoder::copy_positions(void* positions, std::size_t stride) const {
  const std::span<const Quad> indices = positions_->indices();
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

void ElpDecoder::copy_lattice(std::span<std::int32_t> target) const {
  const std::span<const Quad> indices = positions_->indices();
  for (std::size_t v = 0; v < indices.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      target[3 * std::size_t{mesh_->order[v]} + axis] =
          shift_to_coarse(indices[v][axis], flagged(v) ? 0 : lattice_.shift());
    }
  }
}

void ElpDecoder::copy_flags(std::span<std::uint8_t> target) const {
  for (std::size_t v = 0; v < mesh_->order.size(); ++v) target[mesh_->order[v]] = flagged(v) ? 1 : 0;
}

}  // namespace tvg
