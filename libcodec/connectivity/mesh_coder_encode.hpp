#pragma once
#include "connectivity/mesh_coder.hpp"

#include <cstdint>
#include <vector>

namespace tvg {

/// A mesh chunk's payload (format-spec §4.3), and the mesh as the decoder will know it. Frames are given in
/// the order of `mesh` on both sides, unless `keep_order` is false: the decoder then gives them in traversal
/// order.
struct EncodedMesh {
  std::vector<std::uint8_t> payload;
  CodedMesh coded;
};

EncodedMesh encode_mesh(const Mesh& mesh, bool keep_order);

}  // namespace tvg
