#include "prediction/pyramid_weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tvg {

namespace {

constexpr std::size_t kMost = kMaxPyramidNeighbours;
constexpr double kAffine = 500;   ///< of the kernel: how much more a miss of affine functions weighs
constexpr double kNoise = 1e-4;   ///< what keeps points that coincide apart
constexpr double kLargest = 1.9;  ///< of a weight: fits 16 bits with what rounding adds

using Row = std::array<double, kMost>;

/// The kernel r^1.75 + 500 r^2 of squared distances.
void kernel(const Row& squared, std::size_t count, double scale, Row& values) {
  for (std::size_t i = 0; i < count; ++i) {
    const double r2 = squared[i] * scale, r = std::sqrt(r2), root = std::sqrt(r);
    values[i] = r * root * std::sqrt(root) + kAffine * r2;
  }
}

/// Solves a symmetric positive definite system whose right side is all ones, from its upper triangle. False
/// when it is not definite.
bool solve(std::array<Row, kMost>& a, std::size_t n, Row& x) {
  std::fill_n(x.begin(), n, 1.0);
  std::array<double, kMost> inverse{};
  for (std::size_t k = 0; k < n; ++k) {
    if (!(a[k][k] > 0)) return false;
    inverse[k] = 1 / a[k][k];
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[k][i] * inverse[k];
      for (std::size_t j = i; j < n; ++j) a[i][j] -= factor * a[k][j];
      x[i] -= factor * x[k];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) x[i] -= a[i][j] * x[j];
    x[i] *= inverse[i];
  }
  return true;
}

}  // namespace

void krige(const ShapePoint& point, std::span<const ShapePoint> around, std::span<std::int16_t> weights) {
  const std::size_t n = around.size();
  Row squared{}, near{}, w{};
  double sum = 0;
  for (std::size_t a = 0; a < n; ++a) {
    squared[a] = squared_distance(around[a], point);
    sum += squared[a];
  }
  const double scale = sum > 0 ? static_cast<double>(n) / sum : 1;
  kernel(squared, n, scale, near);
  std::array<Row, kMost> gram;
  for (std::size_t a = 0; a < n; ++a) {
    Row far{}, between{};
    for (std::size_t b = a + 1; b < n; ++b) far[b - a - 1] = squared_distance(around[a], around[b]);
    kernel(far, n - a - 1, scale, between);
    gram[a][a] = near[a] + near[a] + kNoise;
    for (std::size_t b = a + 1; b < n; ++b) gram[a][b] = near[a] + near[b] - between[b - a - 1];
  }
  const double even = 1 / static_cast<double>(n);
  bool solved = solve(gram, n, w);
  double total = 0;
  for (std::size_t a = 0; a < n; ++a) total += w[a];
  solved = solved && total > 0;
  double shrink = 1;
  for (std::size_t a = 0; a < n; ++a) {
    w[a] = solved ? w[a] / total - even : 0;
    if (w[a] > kLargest - even) shrink = std::min(shrink, (kLargest - even) / w[a]);
    if (w[a] < -kLargest - even) shrink = std::min(shrink, (-kLargest - even) / w[a]);
  }
  constexpr int kOne = 1 << kPyramidWeightBits;
  int rest = kOne;
  for (std::size_t a = 0; a < n; ++a) {
    const int weight = static_cast<int>(std::floor((even + shrink * w[a]) * kOne + 0.5));
    weights[a] = static_cast<std::int16_t>(weight);
    rest -= weight;
  }
  weights[0] = static_cast<std::int16_t>(weights[0] + rest);
}

}  // namespace tvg
