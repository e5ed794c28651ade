#include "attributes/edge_pairs.hpp"

#include <algorithm>

namespace tvg {

namespace {

std::uint32_t start_of(std::span<const Face> faces, std::uint32_t half_edge) {
  return faces[half_edge / 3][half_edge % 3];
}

/// Puts half-edges in the order of a key below `keys`; what is equal stays as it was.
template <class Key>
void sort_by(const Key& key, std::size_t keys, std::span<const std::uint32_t> from,
             std::span<std::uint32_t> to) {
  std::vector<std::uint32_t> place(keys + 1);
  for (const std::uint32_t h : from) ++place[std::size_t{key(h)} + 1];
  for (std::size_t k = 1; k < place.size(); ++k) place[k] += place[k - 1];
  for (const std::uint32_t h : from) to[place[key(h)]++] = h;
}

}  // namespace

std::vector<std::uint32_t> pair_edges(std::span<const Face> faces, std::size_t vertex_count) {
  const auto low = [&](std::uint32_t h) {
    return std::min(start_of(faces, h), start_of(faces, next_corner(h)));
  };
  const auto high = [&](std::uint32_t h) {
    return std::max(start_of(faces, h), start_of(faces, next_corner(h)));
  };
  std::vector<std::uint32_t> sorted(3 * faces.size()), partner(3 * faces.size());
  for (std::uint32_t h = 0; h < partner.size(); ++h) partner[h] = h;
  sort_by(high, vertex_count, partner, sorted);
  sort_by(low, vertex_count, sorted, partner);
  sorted.swap(partner);
  std::fill(partner.begin(), partner.end(), kNoCorner);
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && low(sorted[end]) == low(sorted[begin]) &&
           high(sorted[end]) == high(sorted[begin]))
      ++end;
    if (low(sorted[begin]) == high(sorted[begin])) continue;
    const auto runs_up = [&](std::size_t i) { return start_of(faces, sorted[i]) == low(sorted[begin]); };
    for (std::size_t up = begin, down = begin;; ++up, ++down) {
      while (up < end && !runs_up(up)) ++up;
      while (down < end && runs_up(down)) ++down;
      if (up >= end || down >= end) break;
      partner[sorted[up]] = sorted[down];
      partner[sorted[down]] = sorted[up];
    }
  }
  return partner;
}

}  // namespace tvg
