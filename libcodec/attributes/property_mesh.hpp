#pragma once
#include "planes/reference_shape.hpp"

#include <cstdint>
#include <span>

#include <tvg/types.hpp>

namespace tvg {

/// A mesh as the coding of its properties sees it, the same on either side.
struct PropertyMesh {
  std::span<const Face> faces;           ///< in traversal indices and order
  std::span<const std::uint32_t> order;  ///< [traversal index] = vertex that frames are given for
  const ReferenceShape* shape;           ///< null where the mesh has none

  std::size_t vertex_count() const { return order.size(); }
};

}  // namespace tvg
