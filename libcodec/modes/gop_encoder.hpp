#pragma once
#include "modes/gop_input.hpp"
#include "modes/gop_mesh.hpp"

#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Encodes one GOP to its whole chunk (format-spec §4.5): lattice → prediction → residuals → packets. Fails
/// with kLimitExceeded when a packet is larger than `limits` allow.
Result<std::vector<std::uint8_t>> encode_gop(const GopInput& input, const GopMesh& mesh,
                                             const StreamLimits& limits);

}  // namespace tvg
