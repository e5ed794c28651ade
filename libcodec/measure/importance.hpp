#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// Algorithm 1's flags, 0 or 1 per vertex: 1 for the `share` (0 to 1) of vertices with the highest cost,
/// rounded to the nearest count. Equal costs rank by vertex index, the lower first.
std::vector<std::uint8_t> flag_highest_share(std::span<const double> cost, double share);

/// Flags every vertex whose cost is above `threshold`.
std::vector<std::uint8_t> flag_above(std::span<const double> cost, double threshold);

}  // namespace tvg
