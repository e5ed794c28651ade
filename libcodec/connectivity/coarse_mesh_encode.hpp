#pragma once
#include "connectivity/coarse_mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/levels.hpp>

namespace tvg {

/// The section of coarser meshes (format-spec §5.6), whose vertices are those of a mesh with this order,
/// [traversal index]: vertex. At least one, and no more than kMaxCoarseMeshes. Cannot fail.
std::vector<std::uint8_t> encode_coarse_meshes(const MeshLevels& levels,
                                               std::span<const std::uint32_t> order);

}  // namespace tvg
