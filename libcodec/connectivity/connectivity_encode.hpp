#pragma once
#include "connectivity/connectivity.hpp"

#include <cstdint>
#include <vector>

namespace tvg {

/// What encode_connectivity makes of a mesh.
struct EncodedConnectivity {
  std::vector<std::uint8_t> bytes;   ///< the stream for decode_connectivity
  Connectivity connectivity;         ///< exactly what the decoder will return
  std::vector<std::uint32_t> order;  ///< [traversal index] = vertex index in the mesh
  /// [traversal face]: 3 * face + corner, in the mesh, of the corner that stands first.
  std::vector<std::uint32_t> first_corners;
};

/// Encodes the connectivity of any triangle soup of at most kMaxFaceCount faces whose indices are below its
/// vertex count. Faces keep their winding, but neither their order nor their first corner. Cannot fail.
EncodedConnectivity encode_connectivity(const Mesh& mesh);

}  // namespace tvg
