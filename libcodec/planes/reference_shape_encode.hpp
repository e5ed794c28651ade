#pragma once
#include "planes/reference_shape.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// Writes what decode_reference_shape() reads. All of the shape is valid, and every index in `faces` is below
/// the number of its vertices.
std::vector<std::uint8_t> encode_reference_shape(const ReferenceShape& shape, std::span<const Face> faces);

}  // namespace tvg
