#pragma once
#include "mesh_coder.hpp"
#include "quantization/lattice.hpp"

#include <cstdint>
#include <memory>
#include <vector>

#include <tvg/encoder.hpp>

namespace tvg {

/// A run of frames in memory.
struct GopFrames {
  std::vector<FramePositions> frames;      ///< [frame][vertex][xyz], in the order of the input mesh
  std::vector<std::vector<float>> joints;  ///< [frame][joint][xyz]; empty unless the measure uses them
};

/// One GOP and where it lies. Frames are shared: those of one GOP may mark the next.
struct GopInput {
  std::shared_ptr<const GopFrames> content;
  std::shared_ptr<const GopFrames> marked_by;  ///< what the measure looks at
  const Skeleton* skeleton = nullptr;
  std::uint64_t first_frame = 0;  ///< in the sequence the frames come from
  Lattice lattice;
};

/// Encodes one GOP to its whole chunk (format-spec §4.5): measure → flags → lattice → prediction → residuals
/// → packets. Fails with kLimitExceeded when a packet is larger than `limits` allow.
Result<std::vector<std::uint8_t>> encode_gop(const GopInput& input, const CodedMesh& mesh,
                                             const EncodeOptions& options, const StreamLimits& limits);

}  // namespace tvg
