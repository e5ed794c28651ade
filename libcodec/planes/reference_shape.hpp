#pragma once
#include "base/byte_io.hpp"
#include "connectivity/mesh_coder.hpp"
#include "prediction/pyramid.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// The shape that a mesh's pyramid is derived from: a position for each vertex on a lattice (format-spec
/// §5.3).
struct ReferenceShape {
  static constexpr int kMostBits = 24;

  std::array<double, 3> origin{};                    ///< [xyz], finite, in mesh units: the smallest corner
  double step = 1;                                   ///< finite and above 0, in mesh units
  int bits = 1;                                      ///< 1 to kMostBits: indices lie in [0, 2^bits)
  std::uint32_t neighbours = kMinPyramidNeighbours;  ///< of a vertex in the pyramid
  std::vector<std::array<std::int32_t, 3>> indices;  ///< [traversal index][xyz]

  bool operator==(const ReferenceShape&) const = default;
};

/// A mesh's faces, in the order it has them, in traversal indices. Empty without an error only where the mesh
/// has no faces; the only error is kOutOfMemory.
Result<std::vector<Face>> faces_by_traversal(const CodedMesh& mesh);

/// Decodes the reference shape of a mesh of `vertex_count` vertices from all of `section`. `faces` may be in
/// any order and start at any corner; every index in them is below `vertex_count`. Memory and time are in
/// proportion to the counts, the time of what follows the faces also to the bytes. The only errors are
/// kMalformed and kOutOfMemory.
Result<ReferenceShape> decode_reference_shape(Bytes section, std::span<const Face> faces,
                                              std::uint32_t vertex_count);

}  // namespace tvg
