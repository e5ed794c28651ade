#include "player/view/view_extent.hpp"

#include "player/view/bounds.hpp"

#include <algorithm>
#include <cmath>

namespace tvg::player {

namespace {

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

ViewExtent::ViewExtent(const CameraAxes& axes, double slope_x, double slope_y)
    : axes_(axes),
      slopes_{slope_x, slope_y},
      low_{INFINITY, INFINITY},
      high_{-INFINITY, -INFINITY},
      nearest_(-INFINITY) {}

// A point is in the picture where |across - middle| <= slope * (distance - depth), so that the two planes on
// either side give the middle and the distance.
void ViewExtent::extend(double x, double y, double z) {
  const std::array<double, 3> point = {x, y, z};
  const double depth = dot(point, axes_.backward);
  if (!std::isfinite(depth)) return;
  const std::array<double, 2> on_screen = {dot(point, axes_.right), dot(point, axes_.up)};
  for (std::size_t i = 0; i < 2; ++i) {
    low_[i] = std::min(low_[i], on_screen[i] - slopes_[i] * depth);
    high_[i] = std::max(high_[i], on_screen[i] + slopes_[i] * depth);
  }
  nearest_ = std::max(nearest_, depth);
}

void ViewExtent::extend(std::span<const float> positions) {
  bounds_.extend(positions);
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
    extend(double{positions[i]}, double{positions[i + 1]}, double{positions[i + 2]});
}

void ViewExtent::extend(const BoundingBox& box) {
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [&](std::size_t axis) {
      return (corner >> axis & 1) != 0 ? box.high()[axis] : box.low()[axis];
    };
    extend(side(0), side(1), side(2));
    bounds_.extend(side(0), side(1), side(2));
  }
}

void ViewExtent::pad(double margin) {
  for (std::size_t i = 0; i < 2; ++i) {
    const double of_plane = margin * std::hypot(1, slopes_[i]);
    low_[i] -= of_plane;
    high_[i] += of_plane;
  }
  nearest_ += margin;
  bounds_.pad(margin);
}

ViewExtent::Placement ViewExtent::place() const {
  const std::array<double, 3> center = bounds_.center();
  const double room = view_radius(bounds_) / 20;
  if (!std::isfinite(nearest_)) return {center, 20 * room};
  const double depth = dot(center, axes_.backward);
  Placement placement{{}, nearest_ - depth + room};
  std::array<double, 2> middle{};
  for (std::size_t i = 0; i < 2; ++i) {
    middle[i] = (low_[i] + high_[i]) / 2;
    placement.distance = std::max(placement.distance, (high_[i] - low_[i]) / 2 / slopes_[i] - depth);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    placement.target[axis] =
        middle[0] * axes_.right[axis] + middle[1] * axes_.up[axis] + depth * axes_.backward[axis];
  }
  return placement;
}

}  // namespace tvg::player
