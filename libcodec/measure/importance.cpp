#include "measure/importance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tvg {

void smooth_cost(const Mesh& mesh, std::uint32_t times, std::span<double> cost) {
  std::vector<double> sum(cost.size()), count(cost.size());
  for (std::uint32_t pass = 0; pass < times; ++pass) {
    std::copy(cost.begin(), cost.end(), sum.begin());
    std::fill(count.begin(), count.end(), 1.0);
    for (const auto& [a, b, c] : mesh.faces) {
      const double whole = cost[a] + cost[b] + cost[c];
      for (const std::uint32_t v : {a, b, c}) {
        sum[v] += whole - cost[v];
        count[v] += 2;
      }
    }
    for (std::size_t v = 0; v < cost.size(); ++v) cost[v] = sum[v] / count[v];
  }
}

std::vector<std::uint8_t> flag_highest_share(std::span<const double> cost, double share) {
  const double wanted = std::round(std::clamp(share, 0.0, 1.0) * static_cast<double>(cost.size()));
  std::vector<std::uint32_t> ranked(cost.size());
  std::iota(ranked.begin(), ranked.end(), 0u);
  std::stable_sort(ranked.begin(), ranked.end(), [&cost](auto a, auto b) { return cost[a] > cost[b]; });
  std::vector<std::uint8_t> flags(cost.size(), 0);
  for (std::size_t rank = 0; rank < static_cast<std::size_t>(wanted); ++rank) flags[ranked[rank]] = 1;
  return flags;
}

std::vector<std::uint8_t> flag_above(std::span<const double> cost, double threshold) {
  std::vector<std::uint8_t> flags(cost.size());
  std::transform(cost.begin(), cost.end(), flags.begin(), [=](double c) { return c > threshold ? 1 : 0; });
  return flags;
}

}  // namespace tvg
