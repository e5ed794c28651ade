#include <algorithm>
#include <cmath>
#include <limits>

#include <tvg/geometry.hpp>

namespace tvg {

void BoundingBox::extend(double x, double y, double z) {
  if (!std::isfinite(x + y + z)) return;
  const std::array<double, 3> point = {x, y, z};
  if (empty_) low_ = high_ = point;
  empty_ = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low_[axis] = std::min(low_[axis], point[axis]);
    high_[axis] = std::max(high_[axis], point[axis]);
  }
}

void BoundingBox::extend(std::span<const float> positions) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low = {kInfinity, kInfinity, kInfinity}, high = {-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    const float x = positions[i], y = positions[i + 1], z = positions[i + 2];
    if (!((x - x) + (y - y) + (z - z) == 0)) continue;  // somewhere infinite or not a number
    low = {std::min(low[0], x), std::min(low[1], y), std::min(low[2], z)};
    high = {std::max(high[0], x), std::max(high[1], y), std::max(high[2], z)};
  }
  if (low[0] > high[0]) return;
  extend(low[0], low[1], low[2]);
  extend(high[0], high[1], high[2]);
}

void BoundingBox::pad(double margin) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low_[axis] -= margin;
    high_[axis] += margin;
  }
}

std::array<double, 3> BoundingBox::center() const {
  return {(low_[0] + high_[0]) / 2, (low_[1] + high_[1]) / 2, (low_[2] + high_[2]) / 2};
}

double BoundingBox::largest_extent() const {
  return std::max({high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]});
}

double BoundingBox::diagonal() const {
  return std::hypot(high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]);
}

BoundingBox box_around(std::span<const FramePositions> frames) {
  BoundingBox box;
  for (const FramePositions& frame : frames) box.extend(frame);
  return box;
}

}  // namespace tvg
