#pragma once
#include "base/checksum.hpp"
#include "entropy/two_ended_coder.hpp"
#include "modes/elp.hpp"
#include "modes/elp_header.hpp"
#include "modes/gop_chunk_encode.hpp"
#include "modes/gop_input.hpp"
#include "modes/gop_mesh.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace tvg {

/// Encodes a GOP in mode elp, the mirror of ElpDecoder (format-spec §7).
class ElpEncoder {
 public:
  /// `input` and `mesh` must outlive the encoder; the mesh has a pyramid where the predictor asks for it.
  ElpEncoder(const GopInput& input, const GopMesh& mesh);

  /// The packet of the next frame, [vertex][xyz] in the order of the input mesh.
  EncodedFrame take(const FramePositions& frame);
  /// The mode's fields of the header, after the last frame.
  std::vector<std::uint8_t> finish();
  /// Of all frames taken.
  std::uint64_t digest() const { return digest_.value(); }

 private:
  void quantize_frame(const FramePositions& frame);
  EncodedFrame encode(Predictor predictor);
  EncodedFrame encode_smaller();
  bool is_the_shape() const;

  const GopInput& input_;
  const GopMesh& mesh_;
  std::vector<std::uint8_t> flags_;  ///< [traversal index]; empty when the lattice is not hybrid
  PositionCoder positions_;          ///< holds the frame
  std::optional<PyramidCoder> along_pyramid_;
  PredictorSet predictors_;  ///< of the frames taken
  std::uint32_t frames_taken_ = 0;
  TwoEndedEncoder coder_;
  Hasher digest_;
};

}  // namespace tvg
