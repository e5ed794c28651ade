#pragma once
#include "simplify/levels_of_removal.hpp"

#include <cstdint>

#include <tvg/levels.hpp>

namespace tvg {

/// The levels of the vertices and the meshes that were kept, as an encoder makes a pyramid of them. Where
/// there were more levels than vertices can have, those that removed least are one with a neighbour. A mesh
/// that is the original, or the one kept before it, is left out.
MeshLevels vertex_levels(std::uint32_t vertex_count, const LevelsOfRemoval& run);

}  // namespace tvg
