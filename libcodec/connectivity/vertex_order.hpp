#pragma once
#include "connectivity/connectivity.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Decodes the order of the mesh's vertices from all of `bytes` (format-spec §5.2): [traversal index] =
/// vertex index, a permutation of 0 to gates.size() - 1. The only error is kMalformed.
Result<std::vector<std::uint32_t>> decode_order(std::span<const std::uint8_t> bytes,
                                                std::span<const Gate> gates);

}  // namespace tvg
