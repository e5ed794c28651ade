#pragma once
#include "base/checksum.hpp"
#include "modes/position_digest.hpp"
#include "planes/plane_coder.hpp"
#include "planes/pyramid_coder.hpp"
#include "planes/reference_shape.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include <tvg/types.hpp>

// What encoder and decoder of a GOP in mode elp share (format-spec §7).
namespace tvg {

/// Positions: the planes x, y and z of one frame after the other.
using PositionCoder = PlaneCoder<3>;

/// The predictor of a GOP's `frame` that an encoder uses: nothing comes before the first one.
constexpr Predictor predictor_of(std::uint32_t frame, Predictor asked) {
  return frame == 0 && asked != Predictor::kPyramid && asked != Predictor::kShape ? Predictor::kSpace : asked;
}

/// Codes the frame whose indices `positions` holds (§7.5, §7.7, §7.10), for both directions; false where a
/// decoded index lies outside its lattice. `along_pyramid` is there where frames of the GOP may be predicted
/// so; `shape` is on the GOP's lattice where one may be predicted by it (§7.10).
template <class Coder>
bool code_frame(Coder& coder, Predictor predictor, PositionCoder& positions,
                std::optional<PyramidCoder>& along_pyramid, const ReferenceShape& shape) {
  if (predictor == Predictor::kPyramid) {
    positions.pass();
    return along_pyramid->code(coder, positions.indices());
  }
  bool inside = true;
  if (predictor == Predictor::kShape) {
    positions.pass();
    const std::span<Quad> indices = positions.indices();
    for (std::size_t v = 0; v < indices.size(); ++v)
      indices[v] = {shape.indices[v][0], shape.indices[v][1], shape.indices[v][2]};
  } else {
    inside = positions.code(coder, predictor);
  }
  if (along_pyramid) along_pyramid->follow(std::as_const(positions).indices());
  return inside;
}

/// Whether the shape's indices are those of positions on this lattice.
inline bool shape_is_on(const ReferenceShape& shape, const Lattice& lattice) {
  return !shape.indices.empty() && !lattice.hybrid() && shape.bits == lattice.fine_bits;
}

/// Adds a frame to the digest of positions: its padded indices.
inline void add_to_digest(Hasher& digest, std::span<const Quad> indices) {
  add_positions_to_digest(digest, indices.size(),
                          [indices](std::size_t v, std::size_t axis) { return indices[v][axis]; });
}

}  // namespace tvg
