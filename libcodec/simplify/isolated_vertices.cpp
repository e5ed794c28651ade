#include "simplify/isolated_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tvg {
namespace {

/// Vertices in use by their first coordinate, along which the nearest is looked for in both directions.
class SortedVertices {
 public:
  SortedVertices(std::span<const std::uint8_t> used, std::uint32_t vertex_count,
                 std::span<const float> positions)
      : positions_(positions) {
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
      if (used[v] != 0) order_.push_back(v);
    }
    std::stable_sort(order_.begin(), order_.end(), [this](auto a, auto b) { return x(a) < x(b); });
  }

  std::uint32_t nearest(std::uint32_t vertex) const {
    const auto middle = std::lower_bound(order_.begin(), order_.end(), x(vertex),
                                         [this](std::uint32_t v, double at) { return x(v) < at; });
    best_ = INFINITY;
    for (auto i = middle; i != order_.end() && std::abs(x(*i) - x(vertex)) <= best_; ++i) look_at(vertex, *i);
    for (auto i = middle; i != order_.begin() && std::abs(x(*(i - 1)) - x(vertex)) <= best_; --i) {
      look_at(vertex, *(i - 1));
    }
    return found_;
  }

 private:
  double x(std::uint32_t vertex) const { return positions_[3 * std::size_t{vertex}]; }

  void look_at(std::uint32_t vertex, std::uint32_t other) const {
    const std::size_t a = 3 * std::size_t{vertex}, b = 3 * std::size_t{other};
    const double distance =
        std::hypot(double{positions_[a]} - positions_[b], double{positions_[a + 1]} - positions_[b + 1],
                   double{positions_[a + 2]} - positions_[b + 2]);
    if (distance > best_ || (distance == best_ && other > found_)) return;
    best_ = distance;
    found_ = other;
  }

  std::span<const float> positions_;
  std::vector<std::uint32_t> order_;
  mutable double best_ = 0;
  mutable std::uint32_t found_ = 0;
};

}  // namespace

std::vector<std::uint32_t> stand_ins(std::span<const std::uint8_t> used, std::uint32_t vertex_count,
                                     std::span<const float> positions) {
  std::vector<std::uint32_t> result(vertex_count);
  std::iota(result.begin(), result.end(), 0u);
  const std::uint8_t* const first_unused =
      std::find(used.data(), used.data() + vertex_count, std::uint8_t{0});
  if (first_unused == used.data() + vertex_count) return result;
  const SortedVertices vertices(used, vertex_count, positions);
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    if (used[v] == 0) result[v] = vertices.nearest(v);
  }
  return result;
}

}  // namespace tvg
