#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace tvg {

/// A triangle: three vertex indices, counter-clockwise seen from outside.
using Face = std::array<std::uint32_t, 3>;

/// Connectivity: any triangle soup. Boundaries, several components, non-manifold edges and vertices, isolated
/// vertices, duplicate and degenerate faces are all allowed; every index is below `vertex_count`.
struct Mesh {
  std::uint32_t vertex_count = 0;
  std::vector<Face> faces;  ///< [face][corner]

  bool operator==(const Mesh&) const = default;
};

}  // namespace tvg
