#pragma once
#include "attributes/attribute_grid.hpp"

#include <cstdint>
#include <vector>

namespace tvg {

/// The grid over an attribute's values, whose bits are settled.
AttributeGrid grid_over(const Attribute& attribute);

/// [value][integer]: the nearest places of the grid.
std::vector<std::int32_t> integers_of(const Attribute& attribute, const AttributeGrid& grid);

}  // namespace tvg
