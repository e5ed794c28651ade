#pragma once
#include "attributes/attribute_grid.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// Set in an attribute's domain, as it is written, where it is animated (format-spec §5.7).
inline constexpr std::uint8_t kAnimatedFlag = 128;

/// What frames of a mesh need to know of an animated attribute, on either side (format-spec §5.7.7).
struct AnimatedAttribute {
  std::size_t number = 0;  ///< of the attribute, among all that the mesh has
  AttributeDomain domain = AttributeDomain::kVertex;
  AttributeGrid grid;                    ///< where its numbers lie comes with a GOP
  std::size_t count = 0;                 ///< of values, as they are coded
  std::vector<std::uint32_t> of_corner;  ///< [3 * face + corner], its value; of corners only
  std::vector<std::uint32_t> given;      ///< for an encoder, of corners: [value], which of those given it is
};

/// Those of a mesh.
struct AnimatedAttributes {
  std::vector<AnimatedAttribute> list;
  std::vector<Face> faces;  ///< in traversal indices and order; empty where no attribute is animated
};

}  // namespace tvg
