#include "simplify/flat_ring.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace tvg {
namespace {

/// Relative to a mean radius of 1: triangles below it are none.
constexpr double kSmallestArea = 1e-9;
/// A neighbour in the vertex' own place still has a direction and a distance.
constexpr double kSmallestAngle = 1e-4, kSmallestRadius = 1e-3;
constexpr double kLargestExponent = 3;

bool cross(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  return doubled_area(a, b, c) * doubled_area(a, b, d) < 0 &&
         doubled_area(c, d, a) * doubled_area(c, d, b) < 0;
}

/// Whether the segment from corner `a` to `b` crosses a side of the polygon between corners `first` and
/// `last`.
bool is_hidden(std::span<const PlanePoint> polygon, std::size_t a, std::size_t b, std::size_t first,
               std::size_t last) {
  for (std::size_t m = first; m < last; ++m) {
    if (m == a || m == b || m + 1 == a || m + 1 == b) continue;
    if (cross(polygon[a], polygon[b], polygon[m], polygon[m + 1])) return true;
  }
  return false;
}

double cosine_at(const PlanePoint& apex, const PlanePoint& a, const PlanePoint& b) {
  const double ax = a[0] - apex[0], ay = a[1] - apex[1], bx = b[0] - apex[0], by = b[1] - apex[1];
  return (ax * bx + ay * by) / std::sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
}

bool holds_a_corner(std::span<const PlanePoint> polygon, std::size_t i, std::size_t k, std::size_t j) {
  for (std::size_t m = i + 1; m < j; ++m) {
    if (m == k) continue;
    const auto weights = weights_in(polygon[m], polygon[i], polygon[k], polygon[j]);
    if (*std::min_element(weights.begin(), weights.end()) >= 0) return true;
  }
  return false;
}

/// The corner between `i` and `j` that sees their segment under the largest angle: no corner that it sees
/// lies in the circle of the three.
std::optional<std::size_t> apex_over(std::span<const PlanePoint> polygon, std::size_t i, std::size_t j) {
  std::optional<std::size_t> best;
  double best_cosine = 2;
  for (std::size_t k = i + 1; k < j; ++k) {
    if (doubled_area(polygon[i], polygon[k], polygon[j]) < kSmallestArea) continue;
    const double cosine = cosine_at(polygon[k], polygon[i], polygon[j]);
    if (cosine >= best_cosine) continue;
    if (is_hidden(polygon, i, k, i, j) || is_hidden(polygon, k, j, i, j) ||
        holds_a_corner(polygon, i, k, j)) {
      continue;
    }
    best = k;
    best_cosine = cosine;
  }
  return best;
}

}  // namespace

double doubled_area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::vector<PlanePoint> flatten_ring(std::span<const double> angles, std::span<const double> radii,
                                     bool closed) {
  double whole = 0;
  for (const double angle : angles) whole += std::max(angle, kSmallestAngle);
  const double exponent = (closed ? 2 : 1) * std::numbers::pi / whole;
  const double mean = std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
  std::vector<PlanePoint> points;
  double angle = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double relative = mean > 0 ? std::max(radii[i] / mean, kSmallestRadius) : 1;
    const double radius = std::pow(relative, std::min(exponent, kLargestExponent));
    const bool end_of_chain = !closed && i + 1 == radii.size();
    points.push_back(end_of_chain ? PlanePoint{-radius, 0}
                                  : PlanePoint{radius * std::cos(angle), radius * std::sin(angle)});
    if (i < angles.size()) angle += exponent * std::max(angles[i], kSmallestAngle);
  }
  return points;
}

std::vector<RingTriangle> delaunay_of_polygon(std::span<const PlanePoint> polygon) {
  std::vector<RingTriangle> triangles;
  std::vector<std::pair<std::size_t, std::size_t>> left = {{0, polygon.size() - 1}};
  while (!left.empty()) {
    const auto [i, j] = left.back();
    left.pop_back();
    if (i + 1 >= j) continue;
    const std::optional<std::size_t> k = apex_over(polygon, i, j);
    if (!k) return {};
    triangles.push_back(
        {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(*k), static_cast<std::uint32_t>(j)});
    left.emplace_back(i, *k);
    left.emplace_back(*k, j);
  }
  return triangles;
}

std::vector<RingTriangle> fan_of_polygon(std::span<const PlanePoint> polygon, std::uint32_t apex) {
  const auto n = static_cast<std::uint32_t>(polygon.size());
  std::vector<RingTriangle> triangles;
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    const std::uint32_t b = (apex + i) % n, c = (apex + i + 1) % n;
    if (doubled_area(polygon[apex], polygon[b], polygon[c]) < kSmallestArea) return {};
    triangles.push_back({apex, b, c});
  }
  return triangles;
}

std::array<double, 3> weights_in(const PlanePoint& point, const PlanePoint& a, const PlanePoint& b,
                                 const PlanePoint& c) {
  const double whole = doubled_area(a, b, c);
  const double of_a = doubled_area(point, b, c) / whole, of_b = doubled_area(a, point, c) / whole;
  return {of_a, of_b, 1 - of_a - of_b};
}

PlaneLocation locate(const PlanePoint& point, std::span<const std::array<PlanePoint, 3>> triangles) {
  PlaneLocation location;
  double least = -INFINITY;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (!(doubled_area(a, b, c) > 0)) continue;
    const std::array<double, 3> weights = weights_in(point, a, b, c);
    const double smallest = *std::min_element(weights.begin(), weights.end());
    if (smallest > least) {
      least = smallest;
      location = {t, weights};
    }
  }
  double sum = 0;
  for (double& weight : location.weights) sum += weight = std::max(weight, 0.0);
  for (double& weight : location.weights) weight /= sum;
  return location;
}

}  // namespace tvg
