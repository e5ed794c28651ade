#pragma once
#include "connectivity/connectivity.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// Encodes the levels of vertices, [traversal index], of which none up to the highest is left out, for
/// decode_levels(). Cannot fail.
std::vector<std::uint8_t> encode_levels(std::span<const std::uint8_t> levels, std::span<const Gate> gates);

}  // namespace tvg
