#pragma once
#include "base/checksum.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tvg {

/// Adds a frame to the digest of positions (format-spec §7.6): `number(vertex, axis)` for x, y and z of each
/// vertex, [traversal index].
template <class Number>
void add_positions_to_digest(Hasher& digest, std::size_t vertex_count, const Number& number) {
  constexpr std::size_t kAtOnce = 256;
  std::array<std::int32_t, 3 * kAtOnce> numbers;
  for (std::size_t first = 0; first < vertex_count; first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, vertex_count - first);
    for (std::size_t v = 0; v < count; ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) numbers[3 * v + axis] = number(first + v, axis);
    }
    digest.update(std::span<const std::int32_t>(numbers).first(3 * count));
  }
}

}  // namespace tvg
