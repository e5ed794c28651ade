#pragma once
#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

// Which vertices of a mesh stay the longest when it is simplified, and the meshes on the way.
namespace tvg {

/// Levels of vertices: what takes part in a coarser mesh has a lower one.
inline constexpr std::uint32_t kMaxVertexLevels = 64;
/// Coarser meshes of one.
inline constexpr std::uint32_t kMaxCoarseMeshes = 16;

/// A coarser mesh over some of a mesh's vertices.
struct CoarseMesh {
  std::uint32_t levels = 0;  ///< it has the vertices of levels 0 to levels - 1, at least one of each
  std::vector<Face> faces;   ///< [face][corner] vertices of the whole mesh, all of these levels
};

/// The levels of a mesh's vertices, and coarser meshes that are to be had without the finer levels.
struct MeshLevels {
  std::vector<std::uint8_t> level;  ///< [vertex] 0 stays to the last; none up to the highest is left out
  std::vector<CoarseMesh> coarse;   ///< the finest first: each has fewer levels than the one before it
};

}  // namespace tvg
