#include "basis/coefficient_planes.hpp"

#include "base/allocation.hpp"

#include <algorithm>

namespace tvg {

bool CoefficientPlanes::reserve(std::size_t vertices, std::size_t components) {
  vertices_ = vertices;
  large_.clear();
  if (!try_resize(most_, components)) return false;
  pairs_.clear();
  const std::uint64_t count = std::uint64_t{block_count()} * pair_count();
  return count <= static_cast<std::size_t>(-1) && try_resize(pairs_, static_cast<std::size_t>(count));
}

bool CoefficientPlanes::put(std::size_t group, std::span<const Quad> values) {
  const std::size_t first = 4 * group, count = std::min<std::size_t>(4, most_.size() - first);
  Quad most{};
  for (const Quad& quad : values) {
    for (std::size_t j = 0; j < 4; ++j) most[j] = std::max(most[j], quad[j] < 0 ? -quad[j] : quad[j]);
  }
  for (std::size_t j = 0; j < count; ++j) {
    most_[first + j] = most[j];
    if (most[j] > 0x7FFF) {
      Large plane{first + j, {}};
      if (!try_resize(plane.values, block_count() * kAtOnce)) return false;
      for (std::size_t v = 0; v < values.size(); ++v) plane.values[v] = values[v][j];
      if (!try_push_back(large_, std::move(plane))) return false;
      continue;
    }
    const std::size_t pair = (first + j) / 2, side = j % 2;
    for (std::size_t v = 0; v < values.size(); ++v)
      pairs_[v / kAtOnce * pair_count() + pair][v % kAtOnce][side] = static_cast<std::int16_t>(values[v][j]);
  }
  return true;
}

}  // namespace tvg
