#pragma once
#include "base/checksum.hpp"
#include "connectivity/mesh_coder.hpp"
#include "entropy/range_coder.hpp"
#include "modes/elp.hpp"
#include "modes/gop_input.hpp"

#include <cstdint>
#include <vector>

namespace tvg {

/// Encodes a GOP in mode elp, the mirror of ElpDecoder (format-spec §7).
class ElpEncoder {
 public:
  /// `input` and `mesh` must outlive the encoder.
  ElpEncoder(const GopInput& input, const CodedMesh& mesh);

  /// The mode's fields of the header.
  std::vector<std::uint8_t> begin();
  /// How the next frame is predicted.
  Predictor predictor() const { return predictor_of(frames_taken_, input_.predictor); }
  /// The packet of the next frame, [vertex][xyz] in the order of the input mesh.
  std::vector<std::uint8_t> take(const FramePositions& frame);
  /// Of all frames taken.
  std::uint64_t digest() const { return digest_.value(); }

 private:
  void quantize_frame(const FramePositions& frame);

  const GopInput& input_;
  const CodedMesh& mesh_;
  std::vector<std::uint8_t> flags_;  ///< [traversal index]; empty when the lattice is not hybrid
  PositionCoder positions_;
  std::uint32_t frames_taken_ = 0;
  RangeEncoder coder_;
  Hasher digest_;
};

}  // namespace tvg
