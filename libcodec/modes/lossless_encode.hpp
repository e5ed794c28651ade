#pragma once
#include "base/checksum.hpp"
#include "entropy/two_ended_coder.hpp"
#include "modes/gop_chunk_encode.hpp"
#include "modes/gop_input.hpp"
#include "modes/gop_mesh.hpp"
#include "modes/lossless_header.hpp"
#include "planes/ordered_coder.hpp"
#include "planes/reals.hpp"

#include <cstdint>
#include <vector>

namespace tvg {

/// Encodes a GOP in mode lossless, the mirror of LosslessDecoder (format-spec §7.9).
class LosslessEncoder {
 public:
  /// `input` and `mesh`, which has a pyramid, must outlive the encoder.
  LosslessEncoder(const GopInput& input, const GopMesh& mesh);

  /// The packet of the next frame, [vertex][xyz] in the order of the input mesh.
  EncodedFrame take(const FramePositions& frame);
  /// The mode's fields of the header.
  std::vector<std::uint8_t> finish() const { return write_lossless_header(line_); }
  /// Of all frames taken.
  std::uint64_t digest() const { return digest_.value(); }

 private:
  const GopMesh& mesh_;
  LineChoice line_;
  std::vector<Reals> values_;  ///< [traversal index] of the frame
  OrderedCoder along_pyramid_;
  TwoEndedEncoder coder_;
  Hasher digest_;
};

}  // namespace tvg
