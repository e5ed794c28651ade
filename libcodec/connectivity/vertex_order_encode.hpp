#pragma once
#include "connectivity/connectivity.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// Encodes `order`, a permutation of 0 to gates.size() - 1, for decode_order. Cannot fail.
std::vector<std::uint8_t> encode_order(std::span<const std::uint32_t> order, std::span<const Gate> gates);

}  // namespace tvg
