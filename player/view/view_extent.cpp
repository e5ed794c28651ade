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
      flat_low_(low_),
      flat_high_(high_),
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
    flat_low_[i] = std::min(flat_low_[i], on_screen[i]);
    flat_high_[i] = std::max(flat_high_[i], on_screen[i]);
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
    flat_low_[i] -= margin;
    flat_high_[i] += margin;
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
  for (std::size_t i = 0; i < 2; ++i)
    placement.distance = std::max(placement.distance, half(i, depth) / slopes_[i]);
  const std::array<double, 2> middle = {middle_at(0, placement.distance, depth),
                                        middle_at(1, placement.distance, depth)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    placement.target[axis] =
        middle[0] * axes_.right[axis] + middle[1] * axes_.up[axis] + depth * axes_.backward[axis];
  }
  return placement;
}

double ViewExtent::half(std::size_t i, double depth) const {
  return (high_[i] - low_[i]) / 2 - slopes_[i] * depth;
}

/// Where there is room left, the points lie within planes that are less steep than the pyramid's. How far out
/// those are lies at most on the line between what it is for planes without a slope and for the pyramid's.
double ViewExtent::middle_at(std::size_t i, double distance, double depth) const {
  const double flat_half = (flat_high_[i] - flat_low_[i]) / 2;
  const double slope = flat_half / (distance - (half(i, depth) - flat_half) / slopes_[i]);
  return std::lerp((flat_low_[i] + flat_high_[i]) / 2, (low_[i] + high_[i]) / 2, slope / slopes_[i]);
}

}  // namespace tvg::player
