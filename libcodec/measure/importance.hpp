#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Replaces every cost by the mean of its own and that of the corners across the edges of the faces around
/// it, `times` times over. A corner that several faces name counts with each; a vertex without faces keeps
/// its cost.
void smooth_cost(const Mesh& mesh, std::uint32_t times, std::span<double> cost);

/// Algorithm 1's flags, 0 or 1 per vertex: 1 for the `share` (0 to 1) of vertices with the highest cost,
/// rounded to the nearest count. Equal costs rank by vertex index, the lower first.
std::vector<std::uint8_t> flag_highest_share(std::span<const double> cost, double share);

/// Flags every vertex whose cost is above `threshold`.
std::vector<std::uint8_t> flag_above(std::span<const double> cost, double threshold);

}  // namespace tvg
