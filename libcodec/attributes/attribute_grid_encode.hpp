#pragma once
#include "attributes/attribute_grid.hpp"
#include "base/byte_io.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// Numbers of an attribute, [value][component].
using AttributeValues = std::span<const float>;

/// The grid over all values in each of `frames`, where `like` says all but where they lie.
AttributeGrid grid_over(AttributeGrid like, std::span<const AttributeValues> frames);

/// [value][integer]: the nearest places of the grid.
std::vector<std::int32_t> integers_of(AttributeValues values, const AttributeGrid& grid);

/// Writes where the numbers lie, where the grid has steps.
void write_steps(ByteWriter& writer, const AttributeGrid& grid);

}  // namespace tvg
