#include "modes/elp_encode.hpp"

#include "modes/gop_flags_encode.hpp"

#include <utility>

namespace tvg {

namespace {

bool may_use_pyramid(Predictor predictor) {
  return predictor == Predictor::kPyramid || predictor == Predictor::kAuto;
}

}  // namespace

ElpEncoder::ElpEncoder(const GopInput& input, const GopMesh& mesh)
    : input_(input),
      mesh_(mesh),
      flags_(flags_in_traversal_order(input, mesh.coded)),
      positions_(Schedule(mesh.coded.gates), flags_, input.lattice) {
  if (may_use_pyramid(input.predictor)) along_pyramid_.emplace(*mesh.pyramid, flags_, input.lattice);
}

// format-spec §7.4
std::vector<std::uint8_t> ElpEncoder::finish() {
  return write_elp_header(predictors_, input_.lattice, encode_flags(mesh_.coded, flags_));
}

// format-spec §7.5
EncodedFrame ElpEncoder::take(const FramePositions& frame) {
  positions_.next();
  quantize_frame(frame);
  const Predictor asked =
      input_.predictor == Predictor::kShape && !is_the_shape() ? Predictor::kElp : input_.predictor;
  EncodedFrame encoded =
      asked == Predictor::kAuto ? encode_smaller() : encode(predictor_of(frames_taken_, asked));
  ++frames_taken_;
  predictors_.add(encoded.predictor);
  add_to_digest(digest_, std::as_const(positions_).indices());
  return encoded;
}

EncodedFrame ElpEncoder::encode(Predictor predictor) {
  code_frame(coder_, predictor, positions_, along_pyramid_, mesh_.shape);
  return {predictor, coder_.finish()};
}

/// Tries both, each from where the frames before have left the models, and goes on from the smaller.
EncodedFrame ElpEncoder::encode_smaller() {
  const PositionCoder positions_before = positions_;
  const std::optional<PyramidCoder> pyramid_before = along_pyramid_;
  EncodedFrame by_gates = encode(predictor_of(frames_taken_, Predictor::kElp));
  PositionCoder positions_after = std::exchange(positions_, positions_before);
  std::optional<PyramidCoder> pyramid_after = std::exchange(along_pyramid_, pyramid_before);
  EncodedFrame by_pyramid = encode(Predictor::kPyramid);
  if (by_pyramid.content.size() <= by_gates.content.size()) return by_pyramid;
  positions_ = std::move(positions_after);
  along_pyramid_ = std::move(pyramid_after);
  return by_gates;
}

/// Whether the frame that was quantized is the mesh's reference shape.
bool ElpEncoder::is_the_shape() const {
  const std::span<const Quad> indices = positions_.indices();
  const auto& shape = mesh_.shape.indices;
  if (!shape_is_on(mesh_.shape, input_.lattice) || shape.size() != indices.size()) return false;
  for (std::size_t v = 0; v < shape.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (indices[v][axis] != shape[v][axis]) return false;
    }
  }
  return true;
}

/// Quantizes a frame to the fine lattice; what has no flag then loses the bits its own lattice does not have.
void ElpEncoder::quantize_frame(const FramePositions& frame) {
  const Lattice lattice = input_.lattice;  // a copy: the indices written below cannot be part of it
  const int shift = lattice.shift();
  const std::span<Quad> indices = positions_.indices();
  for (std::size_t v = 0; v < indices.size(); ++v) {
    const bool fine = flags_.empty() || flags_[v] != 0;
    indices[v] = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t index =
          quantize(frame[3 * std::size_t{mesh_.coded.order[v]} + axis], lattice.origin[axis], lattice);
      indices[v][axis] = fine ? index : pad_to_fine(shift_to_coarse(index, shift), shift);
    }
  }
}

}  // namespace tvg
