#include "encoder/importers/corner_weld.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tvg::cli {

namespace {

/// Sets of points that are united two by two.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t root(std::uint32_t point) {
    while (parent_[point] != point) point = parent_[point] = parent_[parent_[point]];
    return point;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t x = root(a);
    const std::uint32_t y = root(b);
    if (x < y) parent_[y] = x;
    if (y < x) parent_[x] = y;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

bool in_one_place(std::span<const float> points, std::size_t a, std::size_t b, double tolerance) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(double{points[3 * a + axis]} - double{points[3 * b + axis]}) > tolerance) return false;
  }
  return true;
}

/// Points in cells far larger than the tolerance, so that few have neighbours in another cell.
class Grid {
 public:
  Grid(std::span<const float> points, double tolerance)
      : points_(points), tolerance_(tolerance), cell_(kCell * tolerance), next_(points.size() / 3, kNone) {}

  /// Calls visit(other) for each point inserted before that may be in the place of `point`.
  template <class Visit>
  void for_each_near(std::uint32_t point, Visit&& visit) const {
    std::array<std::int64_t, 3> low{};
    std::array<std::int64_t, 3> high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = index(double{points_[3 * std::size_t{point} + axis]} - tolerance_);
      high[axis] = index(double{points_[3 * std::size_t{point} + axis]} + tolerance_);
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto cell = head_.find(hash({x, y, z}));
          if (cell == head_.end()) continue;
          for (std::uint32_t other = cell->second; other != kNone; other = next_[other]) visit(other);
        }
      }
    }
  }

  void insert(std::uint32_t point) {
    std::array<std::int64_t, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      at[axis] = index(double{points_[3 * std::size_t{point} + axis]});
    const auto [cell, is_new] = head_.try_emplace(hash(at), point);
    if (!is_new) next_[point] = std::exchange(cell->second, point);
  }

 private:
  static constexpr double kCell = 4;
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::int64_t index(double coordinate) const {
    constexpr double kMost = 4e18;
    return static_cast<std::int64_t>(std::fmax(-kMost, std::fmin(kMost, std::floor(coordinate / cell_))));
  }
  static std::uint64_t hash(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t hash = 0;
    for (const std::int64_t index : cell) hash = mix_hash(hash, static_cast<std::uint64_t>(index));
    return hash;
  }

  std::span<const float> points_;
  double tolerance_;
  double cell_;
  std::unordered_map<std::uint64_t, std::uint32_t> head_;
  std::vector<std::uint32_t> next_;
};

/// The weld that puts points with equal labels together.
Weld weld_labels(const std::vector<std::uint64_t>& labels) {
  return weld_points(
      labels.size(), [&](std::uint32_t point) { return mix_hash(0, labels[point]); },
      [&](std::uint32_t a, std::uint32_t b) { return labels[a] == labels[b]; });
}

std::vector<bool> torn_vertices(const Weld& weld, std::span<const float> points, double tolerance) {
  std::vector<bool> torn(weld.vertex_count(), false);
  for (std::size_t point = 0; point < weld.vertex_of_point.size(); ++point) {
    const std::uint32_t vertex = weld.vertex_of_point[point];
    if (!in_one_place(points, point, weld.first_point[vertex], tolerance)) torn[vertex] = true;
  }
  return torn;
}

}  // namespace

Weld weld_within(std::span<const float> points, double tolerance) {
  Weld exact = weld_positions(points);
  if (!(tolerance > 0)) return exact;
  std::vector<float> places;
  places.reserve(3 * std::size_t{exact.vertex_count()});
  for (const std::uint32_t point : exact.first_point) {
    for (std::size_t axis = 0; axis < 3; ++axis) places.push_back(points[3 * std::size_t{point} + axis]);
  }
  UnionFind sets(exact.vertex_count());
  Grid grid(places, tolerance);
  for (std::uint32_t place = 0; place < exact.vertex_count(); ++place) {
    grid.for_each_near(place, [&](std::uint32_t other) {
      if (in_one_place(places, place, other, tolerance)) sets.unite(place, other);
    });
    grid.insert(place);
  }
  std::vector<std::uint64_t> labels;
  labels.reserve(exact.vertex_of_point.size());
  for (const std::uint32_t place : exact.vertex_of_point) labels.push_back(sets.root(place));
  return weld_labels(labels);
}

Weld split_weld(const Weld& weld, std::span<const float> points, double tolerance) {
  const std::vector<bool> torn = torn_vertices(weld, points, tolerance);
  const Weld here = weld_within(points, tolerance);
  std::vector<std::uint64_t> labels;
  labels.reserve(weld.vertex_of_point.size());
  for (std::size_t point = 0; point < weld.vertex_of_point.size(); ++point) {
    const std::uint32_t vertex = weld.vertex_of_point[point];
    // A vertex of either weld may lie in several of the other.
    const std::uint64_t part = torn[vertex] ? std::uint64_t{here.vertex_of_point[point]} + 1 : 0;
    labels.push_back(part << 32 | vertex);
  }
  return weld_labels(labels);
}

std::size_t count_torn(const Weld& weld, std::span<const float> points, double tolerance,
                       std::size_t& first) {
  const std::vector<bool> torn = torn_vertices(weld, points, tolerance);
  std::size_t count = 0;
  for (const bool is_torn : torn) count += is_torn ? 1 : 0;
  for (first = 0; count > 0 && first < weld.vertex_of_point.size(); ++first) {
    const std::uint32_t vertex = weld.vertex_of_point[first];
    if (torn[vertex] && !in_one_place(points, first, weld.first_point[vertex], tolerance)) break;
  }
  return count;
}

}  // namespace tvg::cli
