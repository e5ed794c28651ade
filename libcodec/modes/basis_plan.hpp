#pragma once
#include "base/byte_io.hpp"
#include "basis/basis_header.hpp"
#include "basis/coefficient_planes.hpp"
#include "container/gop_header.hpp"
#include "modes/gop_mesh.hpp"

#include <cstdint>
#include <memory>
#include <span>
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
  std::uint64_t number = 0;          ///< another for each that a decoder makes, counted from 1
  CoefficientPlanes planes;          ///< in order of traversal; of a coarser mesh its vertices as they are

  bool flagged(std::size_t t) const { return flags.empty() || flags[t] != 0; }
  /// [vertex of the planes]: which vertex drawn it is; empty where they are the same.
  std::span<const std::uint32_t> order() const {
    return mesh->coded.cut.whole() ? std::span<const std::uint32_t>(mesh->coded.order)
                                   : std::span<const std::uint32_t>();
  }
};

/// The fields of a chunk of planes, where others add to it that are wanted too; or, of the last that is
/// wanted, the basis that all of them are (format-spec §7.8.1).
struct PlanPart {
  std::shared_ptr<const BasisPlan> plan;
  std::vector<std::uint8_t> fields;
  std::shared_ptr<const PlanPart> before;  ///< what it adds to
};

/// Decodes a plan in mode basis from the fields of its parts, as many as this mesh, which it is for, wants as
/// it is drawn. Of its components only so many are decoded, in groups of four; the others are left out.
/// kMalformed, kLimitExceeded, kDigestMismatch, kOutOfMemory.
Result<BasisPlan> decode_basis_plan(std::span<const Bytes> parts, std::shared_ptr<const GopMesh> mesh,
                                    const StreamLimits& limits, std::uint32_t most_components);

/// What headers say of a GOP in mode basis; all vertices count as flagged.
GopInfo basis_gop_info(const GopHeader& header, const BasisHeader& basis);

}  // namespace tvg
