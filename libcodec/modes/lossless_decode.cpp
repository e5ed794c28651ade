#include "modes/lossless_decode.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "entropy/two_ended_coder.hpp"
#include "modes/lossless_take.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace tvg {

// format-spec §7.9
Status LosslessDecoder::begin(const GopHeader& header, std::shared_ptr<const GopMesh> mesh) {
  LosslessHeader lossless;
  if (Status status = read_lossless_header(header, lossless); !status.ok()) return status;
  if (!mesh->pyramid)
    return malformed("§4.5.1", "a GOP in mode lossless needs the pyramid of a mesh that has none");
  const std::size_t vertex_count = mesh->coded.gates.size();
  along_pyramid_.reset();
  if (!can_allocate(vertex_count * (OrderedCoder::kBytesPerVertex + sizeof(Reals)) +
                    OrderedCoder::kMostOtherBytes))
    return out_of_memory();
  mesh_ = std::move(mesh);
  channels_ = lossless.channels;
  info_ = lossless_gop_info(header);
  info_.flagged = mesh_->coded.drawn().vertex_count;
  values_.assign(vertex_count, Reals{});
  along_pyramid_.emplace(*mesh_->pyramid, mesh_->shape, lossless.line.line());
  digest_ = Hasher();
  return {};
}

// format-spec §4.5.2
Result<Bytes> LosslessDecoder::open(Bytes packet, Predictor predictor) const {
  if (predictor != Predictor::kPyramid)
    return malformed("§4.5.2", "a frame in mode lossless is not predicted along the pyramid");
  return positions_piece(channels_, packet);
}

Status LosslessDecoder::take(Bytes packet, Predictor predictor) {
  const Result<Bytes> positions = open(packet, predictor);
  if (!positions) return positions.error();
  TwoEndedDecoder coder(*positions);
  return decode(coder);
}

// format-spec §7.6
Status LosslessDecoder::check_digest(Bytes packet) const {
  return compare_digest(channels_, packet, digest_.value());
}

void LosslessDecoder::copy_positions(void* positions, std::size_t stride) const {
  auto* const target = static_cast<std::byte*>(positions);
  mesh_->coded.for_each_drawn([&](std::uint32_t t, std::uint32_t v) {
    std::array<std::uint32_t, 3> bits;
    for (std::size_t axis = 0; axis < 3; ++axis) bits[axis] = float_of_value(values_[t][axis]);
    std::memcpy(target + stride * v, bits.data(), sizeof bits);
  });
}

void LosslessDecoder::copy_lattice(std::span<std::int32_t> numbers) const {
  mesh_->coded.for_each_drawn([&](std::uint32_t t, std::uint32_t v) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      numbers[3 * std::size_t{v} + axis] = ordered(float_of_value(values_[t][axis]));
  });
}

void LosslessDecoder::copy_flags(std::span<std::uint8_t> flags) const {
  std::fill_n(flags.begin(), info_.flagged, std::uint8_t{1});
}

}  // namespace tvg
