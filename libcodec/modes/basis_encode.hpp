#pragma once
#include "modes/gop_encoder.hpp"

namespace tvg {

/// Bits of the lattice whose error a basis can have: with more, coefficients and rows would leave their
/// bounds.
inline constexpr int kMostBasisBits = 16;

/// Encodes a period in mode basis, the mirror of decode_basis_plan() and BasisDecoder (format-spec §7.8). The
/// mesh has a pyramid.
Result<EncodedRun> encode_basis(const GopInput& input, const GopMesh& mesh, const StreamLimits& limits);

}  // namespace tvg
