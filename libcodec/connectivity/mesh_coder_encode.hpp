#pragma once
#include "connectivity/mesh_coder.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/levels.hpp>

namespace tvg {

/// The sections of a mesh that say how it hangs together (format-spec §5.1, §5.2, §5.5, §5.6), and the mesh
/// as the decoder will know it. Frames are given in the order of `mesh` on both sides, unless `keep_order` is
/// false: the decoder then gives them in traversal order.
struct EncodedMesh {
  std::vector<std::uint8_t> connectivity, order;
  std::vector<std::uint8_t> levels, lods;                 ///< empty where there are none
  std::vector<std::uint8_t> parts, attributes, polygons;  ///< likewise
  CodedMesh coded;                                        ///< not named yet: the payload names it
  std::vector<Face> faces;                   ///< in traversal indices and order, as the decoder meets them
  std::vector<std::uint32_t> first_corners;  ///< of these, as in EncodedConnectivity
};

/// `levels` fit the mesh; null where there are none.
EncodedMesh encode_mesh(const Mesh& mesh, bool keep_order, const MeshLevels* levels = nullptr);

/// The payload of the mesh's chunk (§4.3), with a reference shape (§5.3) where that is not empty; names the
/// mesh.
std::vector<std::uint8_t> mesh_payload(EncodedMesh& mesh, std::span<const std::uint8_t> shape = {});

}  // namespace tvg
