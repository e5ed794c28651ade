#pragma once
#include "base/byte_io.hpp"

#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// §4.3: counts and the sections that this version knows.
struct MeshLayout {
  std::uint32_t vertex_count, face_count;
  bool keeps_order;  ///< there is a section with the vertex order; otherwise it was given up
  Bytes connectivity, order;
  Bytes shape = {};       ///< the reference shape; empty where there is none
  Bytes levels = {};      ///< of the vertices; empty where there are none
  Bytes lods = {};        ///< the coarser meshes; empty where there are none
  Bytes parts = {};       ///< which part each face is of; empty where there are none
  Bytes attributes = {};  ///< empty where there are none
  Bytes polygons = {};    ///< empty where all faces are triangles
};
std::vector<std::uint8_t> write_mesh(const MeshLayout& mesh);
/// kUnsupported where there is a section that this version does not know and must.
Result<MeshLayout> read_mesh(Bytes payload);

/// A bound of what a mesh chunk of such a stream may take, with a reference shape or without, with levels and
/// so many coarser meshes.
std::uint32_t most_mesh_bytes(const StreamLimits& limits, bool with_shape, std::size_t coarse_meshes = 0);

/// Whether a mesh is as small as the head says.
Status check_mesh_size(const MeshLayout& mesh, const StreamLimits& limits);

}  // namespace tvg
