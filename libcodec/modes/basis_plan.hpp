#pragma once
#include "base/byte_io.hpp"
#include "basis/basis_header.hpp"
#include "basis/coefficient_planes.hpp"
#include "container/gop_header.hpp"
#include "modes/gop_mesh.hpp"

#include <cstdint>
#include <memory>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A basis as the GOPs that share it need it: what its PLAN chunk holds (format-spec §7.8).
struct BasisPlan {
  std::shared_ptr<const GopMesh> mesh;
  BasisHeader header;                ///< its scales are `scales`, its flags gone
  std::vector<std::uint8_t> scales;  ///< [row]
  std::vector<std::uint8_t> flags;   ///< [traversal index]; empty where there is one lattice
  CoefficientPlanes planes;
};

/// Decodes the fields of a plan in mode basis, for this mesh. Of its components only so many are decoded, in
/// groups of four; the others are left out. kMalformed, kLimitExceeded, kDigestMismatch, kOutOfMemory.
Result<BasisPlan> decode_basis_plan(Bytes fields, std::shared_ptr<const GopMesh> mesh,
                                    const StreamLimits& limits, std::uint32_t most_components);

/// What headers say of a GOP in mode basis; all vertices count as flagged.
GopInfo basis_gop_info(const GopHeader& header, const BasisHeader& basis);

}  // namespace tvg
