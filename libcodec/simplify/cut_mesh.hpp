#pragma once
#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// A mesh that was cut until the faces around every vertex are one fan, so that half-edges can hold it: where
/// more than two faces meet in an edge, where faces disagree about their sense, and where fans meet in a
/// point. Faces that name a vertex twice are left out.
struct CutMesh {
  std::vector<Face> faces;             ///< [face][corner] vertices of the cut mesh
  std::vector<std::uint32_t> face_of;  ///< [face] the original's
  std::vector<std::uint32_t> partner;  ///< [half-edge] across its edge, or kNoHalfEdge
  std::vector<std::uint32_t> origin;   ///< [vertex] the original's; the first so many are the original's own
  std::vector<std::uint8_t> locked;    ///< [vertex] 1 where it is one of several copies
  std::vector<std::uint8_t> used;      ///< [vertex] 1 where a face names it
  std::vector<std::vector<std::uint32_t>>
      copies;                            ///< [k] vertices that are one in the original, two at least
  std::vector<std::uint32_t> copies_of;  ///< [original's vertex] place in `copies`, or kNoHalfEdge
};

/// Every index of the mesh is below its vertex count.
CutMesh cut_mesh(const Mesh& mesh);

}  // namespace tvg
