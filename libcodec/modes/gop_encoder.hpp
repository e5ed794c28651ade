#pragma once
#include "connectivity/mesh_coder.hpp"
#include "quantization/lattice.hpp"
#include "source/gop_reader.hpp"

#include <cstdint>
#include <memory>
#include <vector>

#include <tvg/encoder.hpp>

namespace tvg {

/// One GOP and where it lies.
struct GopInput {
  GopContent frames;  ///< `first_frame` is that of the sequence the frames come from
  const Skeleton* skeleton = nullptr;
  Lattice lattice;
};

/// Encodes one GOP to its whole chunk (format-spec §4.5): measure → flags → lattice → prediction → residuals
/// → packets. Fails with kLimitExceeded when a packet is larger than `limits` allow.
Result<std::vector<std::uint8_t>> encode_gop(const GopInput& input, const CodedMesh& mesh,
                                             const EncodeOptions& options, const StreamLimits& limits);

}  // namespace tvg
