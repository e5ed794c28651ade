#include "basis/coefficient_planes.hpp"

#include "base/allocation.hpp"

#include <algorithm>
#include <array>

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
  std::array<std::int32_t, 4> small{};  // 1, or 0 for planes that are not kept in pairs
  for (std::size_t j = 0; j < count; ++j) {
    most_[first + j] = most[j];
    small[j] = most[j] <= 0x7FFF ? 1 : 0;
    if (small[j] != 0) continue;
    Large plane{first + j, {}};
    if (!try_resize(plane.values, block_count() * kAtOnce)) return false;
    for (std::size_t v = 0; v < values.size(); ++v) plane.values[v] = values[v][j];
    if (!try_push_back(large_, std::move(plane))) return false;
  }
  for (std::size_t j = 0; j < count; j += 2) {
    PairBlock* block = pairs_.data() + (first + j) / 2;
    for (std::size_t v = 0; v < values.size(); ++v) {
      (*block)[v % kAtOnce] = {static_cast<std::int16_t>(values[v][j] * small[j]),
                               static_cast<std::int16_t>(values[v][j + 1] * small[j + 1])};
      if (v % kAtOnce == kAtOnce - 1) block += pair_count();
    }
  }
  return true;
}

}  // namespace tvg
