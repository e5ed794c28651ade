#include "modes/elp_decode.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "entropy/two_ended_coder.hpp"
#include "modes/elp_take.hpp"
#include "planes/cell_centres.hpp"
#include "quantization/flag_coder.hpp"

#include <algorithm>
#include <cstring>

namespace tvg {

// format-spec §7.4
Status ElpDecoder::begin(const GopHeader& header, std::shared_ptr<const GopMesh> mesh) {
  ElpHeader elp;
  if (Status status = read_elp_header(header, elp); !status.ok()) return status;
  const bool by_pyramid = elp.predictors.has(Predictor::kPyramid);
  if (by_pyramid && !mesh->pyramid)
    return malformed("§4.5.1", "a GOP is predicted along the pyramid of a mesh that has none");
  if (elp.predictors.has(Predictor::kShape) && !shape_is_on(mesh->shape, elp.lattice))
    return malformed("§4.5.1", "a GOP is predicted by a reference shape that is not on its lattice");
  const std::size_t vertex_count = mesh->coded.gates.size();
  std::size_t bytes =
      vertex_count * (PositionCoder::kBytesPerVertex + sizeof(turn_[0]) + 1) + PositionCoder::kMostModelBytes;
  if (by_pyramid) bytes += vertex_count * PyramidCoder::kBytesPerVertex + PyramidCoder::kMostOtherBytes;
  along_pyramid_.reset();
  if (!can_allocate(bytes)) return out_of_memory();
  mesh_ = std::move(mesh);
  channels_ = elp.channels;
  lattice_ = elp.lattice;
  info_ = gop_info(header, elp);
  info_.flagged = static_cast<std::uint32_t>(mesh_->coded.drawn().vertex_count);
  flags_.clear();
  turn_.resize(mesh_->coded.drawn().vertex_count);
  mesh_->coded.for_each_drawn([this](std::uint32_t t, std::uint32_t v) { turn_[v] = t; });
  if (lattice_.hybrid()) {
    flags_.resize(vertex_count);
    if (const Fault fault = decode_flags(elp.flags, mesh_->coded.gates, flags_)) return error_of(fault);
    info_.flagged = static_cast<std::uint32_t>(
        std::count_if(turn_.begin(), turn_.end(), [this](std::uint32_t t) { return flagged(t); }));
  }
  predictors_ = elp.predictors;
  positions_.emplace(Schedule(mesh_->coded.gates), flags_, lattice_);
  if (by_pyramid) along_pyramid_.emplace(*mesh_->pyramid, flags_, lattice_);
  frames_taken_ = 0;
  digest_ = Hasher();
  return {};
}

// format-spec §4.5.2
Result<Bytes> ElpDecoder::open(Bytes packet, Predictor predictor) const {
  if (!predictors_.has(predictor))
    return malformed("§4.5.2", "a frame has a predictor that the GOP's header does not name");
  if (frames_taken_ == 0 && (predictor == Predictor::kTime || predictor == Predictor::kElp))
    return malformed("§4.5.2", "the first frame of a GOP is predicted from one before it");
  return positions_piece(channels_, packet);
}

Status ElpDecoder::take(Bytes packet, Predictor predictor) {
  const Result<Bytes> positions = open(packet, predictor);
  if (!positions) return positions.error();
  TwoEndedDecoder coder(*positions);
  return decode(coder, predictor);
}

// format-spec §7.6
Status ElpDecoder::check_digest(Bytes packet) const {
  return compare_digest(channels_, packet, digest_.value());
}

void ElpDecoder::copy_positions(void* positions, std::size_t stride) const {
  const std::span<const Quad> indices = positions_->indices();
  const int shift = lattice_.shift();
  const CellCentres fine(lattice_.origin, lattice_.step, lattice_.fine_bits);
  const CellCentres coarse(lattice_.origin, lattice_.step * static_cast<double>(std::uint32_t{1} << shift),
                           lattice_.coarse_bits);
  // In the order of the target, for which memory is fetched ahead; the indices are close at hand.
  auto* target = static_cast<std::byte*>(positions);
  for (const std::uint32_t v : turn_) {
    if (flagged(v)) {
      fine.put(indices[v], target);
    } else {
      coarse.put((Lanes(indices[v]) >> shift).quad(), target);
    }
    target += stride;
  }
}

void ElpDecoder::copy_lattice(std::span<std::int32_t> target) const {
  const std::span<const Quad> indices = positions_->indices();
  for (std::size_t v = 0; v < turn_.size(); ++v) {
    const std::uint32_t t = turn_[v];
    for (std::size_t axis = 0; axis < 3; ++axis)
      target[3 * v + axis] = shift_to_coarse(indices[t][axis], flagged(t) ? 0 : lattice_.shift());
  }
}

void ElpDecoder::copy_flags(std::span<std::uint8_t> target) const {
  for (std::size_t v = 0; v < turn_.size(); ++v) target[v] = flagged(turn_[v]) ? 1 : 0;
}

}  // namespace tvg
