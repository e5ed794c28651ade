#include "modes/elp_encode.hpp"

#include "modes/elp_header.hpp"
#include "quantization/flag_coder.hpp"

#include <utility>

namespace tvg {

namespace {

/// Flags in traversal order; empty when there is one lattice only.
std::vector<std::uint8_t> flags_in_traversal_order(const GopInput& input, const CodedMesh& mesh) {
  std::vector<std::uint8_t> flags;
  if (!input.lattice.hybrid()) return flags;
  flags.resize(mesh.order.size());
  for (std::size_t v = 0; v < flags.size(); ++v) flags[v] = input.flags[mesh.order[v]];
  return flags;
}

}  // namespace

ElpEncoder::ElpEncoder(const GopInput& input, const CodedMesh& mesh)
    : input_(input),
      mesh_(mesh),
      flags_(flags_in_traversal_order(input, mesh)),
      positions_(Schedule(mesh.gates), flags_, input.lattice) {}

// format-spec §7.4
std::vector<std::uint8_t> ElpEncoder::begin() {
  const Lattice& lattice = input_.lattice;
  std::vector<std::uint8_t> coded_flags;
  if (lattice.hybrid()) {
    code_flags(coder_, mesh_.gates, flags_);
    coded_flags = coder_.finish();
  }
  return write_elp_header(lattice, coded_flags);
}

// format-spec §7.5
std::vector<std::uint8_t> ElpEncoder::take(const FramePositions& frame) {
  positions_.next();
  quantize_frame(frame);
  positions_.code(coder_, predictor());
  ++frames_taken_;
  add_to_digest(digest_, std::as_const(positions_).indices());
  return coder_.finish();
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
          quantize(frame[3 * std::size_t{mesh_.order[v]} + axis], lattice.origin[axis], lattice);
      indices[v][axis] = fine ? index : pad_to_fine(shift_to_coarse(index, shift), shift);
    }
  }
}

}  // namespace tvg
