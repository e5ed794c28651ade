#pragma once
#include "base/byte_io.hpp"
#include "connectivity/connectivity.hpp"
#include "container/mesh_payload.hpp"

#include <cstdint>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// A mesh as the coding of frames needs it, on either side.
struct CodedMesh {
  Mesh mesh;                         ///< in the order frames are given in
  std::vector<Gate> gates;           ///< [traversal index]
  std::vector<std::uint32_t> order;  ///< [traversal index] = vertex of `mesh`
  MeshInfo info;
  std::uint32_t id = 0;  ///< the mesh chunk's payload checksum, by which GOPs name it
};

/// Decodes a mesh from the sections of its chunk (format-spec §4.3).
Result<CodedMesh> decode_mesh(const MeshLayout& layout, std::uint32_t id);

}  // namespace tvg
