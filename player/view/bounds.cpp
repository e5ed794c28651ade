#include "player/view/bounds.hpp"

#include <algorithm>
#include <cmath>

namespace tvg::cli {

UpAxis up_axis_of(const Metadata& metadata) {
  const auto up = metadata.find("up");
  return up != metadata.end() && up->second == "z" ? UpAxis::kZ : UpAxis::kY;
}

void Bounds::extend(std::span<const float> positions) {
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    const std::array<double, 3> point = {positions[i], positions[i + 1], positions[i + 2]};
    if (!std::isfinite(point[0] + point[1] + point[2])) continue;
    if (empty_) low_ = high_ = point;
    empty_ = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], point[axis]);
      high_[axis] = std::max(high_[axis], point[axis]);
    }
  }
}

void Bounds::pad(double share) {
  if (empty_) return;
  const double margin = 2 * radius() * share;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low_[axis] -= margin;
    high_[axis] += margin;
  }
}

std::array<double, 3> Bounds::center() const {
  return {(low_[0] + high_[0]) / 2, (low_[1] + high_[1]) / 2, (low_[2] + high_[2]) / 2};
}

double Bounds::radius() const {
  const double radius = std::hypot(high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]) / 2;
  return radius > 0 ? radius : 1;
}

}  // namespace tvg::cli
