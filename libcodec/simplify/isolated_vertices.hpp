#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// For each of the first `vertex_count` vertices the one it goes with: itself where it is used, else the one
/// in use that is nearest in these positions ([vertex][xyz]), the lower of equally near ones. At least one is
/// in use.
std::vector<std::uint32_t> stand_ins(std::span<const std::uint8_t> used, std::uint32_t vertex_count,
                                     std::span<const float> positions);

}  // namespace tvg
