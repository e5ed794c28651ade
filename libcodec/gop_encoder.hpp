#pragma once
#include "mesh_coder.hpp"
#include "quantization/lattice.hpp"

#include <cstdint>
#include <vector>

#include <tvg/encoder.hpp>

namespace tvg {

/// The frames of one GOP and where they lie.
struct GopInput {
  std::vector<FramePositions> frames;  ///< [frame][vertex][xyz], in the order of the input mesh
  std::uint64_t first_frame = 0;       ///< in the sequence the frames come from
  Lattice lattice;
};

/// Encodes one GOP to its whole chunk (format-spec §4.5): measure → flags → lattice → prediction → residuals
/// → packets. Fails with kLimitExceeded when a packet is larger than `limits` allow.
Result<std::vector<std::uint8_t>> encode_gop(const GopInput& input, const CodedMesh& mesh,
                                             const EncodeOptions& options, const StreamLimits& limits);

}  // namespace tvg
