#pragma once
#include "modes/gop_chunk_encode.hpp"
#include "modes/gop_input.hpp"
#include "modes/gop_mesh.hpp"

#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// The chunks of a run of frames that are encoded together.
struct EncodedRun {
  std::vector<std::vector<std::uint8_t>> plans;  ///< what the GOPs share, if anything
  std::vector<EncodedGop> gops;
  double largest_error = 0;  ///< in mode basis: of a coordinate, in the mesh's units
};

/// Encodes a run of frames (format-spec §4.5, §4.9): a GOP in mode elp, a period in mode basis. Fails with
/// kLimitExceeded when a packet or a plan is larger than `limits` allow.
Result<EncodedRun> encode_run(const GopInput& input, const GopMesh& mesh, const StreamLimits& limits);

}  // namespace tvg
