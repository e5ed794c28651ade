#pragma once
#include <array>
#include <cstddef>
#include <span>

#include <tvg/geometry.hpp>

namespace tvg::player {

/// Right, up and backward of a camera in the space of the sequence, each of length 1 and square to the
/// others.
struct CameraAxes {
  std::array<double, 3> right{1, 0, 0};
  std::array<double, 3> up{0, 1, 0};
  std::array<double, 3> backward{0, 0, 1};
};

/// How large points are in a picture of a perspective camera whose direction is known and whose place is not:
/// the four planes of its pyramid and the one before it, moved to where they touch the points. Points come
/// one after the other and need not be kept, so that a whole animation may be looked through.
class ViewExtent {
 public:
  /// `slope_x`, `slope_y`: what the pyramid's half width and half height are of the distance.
  ViewExtent(const CameraAxes& axes, double slope_x, double slope_y);

  /// `positions`: [vertex][xyz]. A point with a coordinate that is infinite or not a number does not count.
  void extend(std::span<const float> positions);
  /// The corners of a box; of an empty one, the origin.
  void extend(const BoundingBox& box);
  /// Makes room for every point to move so far.
  void pad(double margin);

  /// The box around the points.
  const BoundingBox& bounds() const { return bounds_; }

  /// Where the camera stands so that the points just fit across or up, and are about in the middle otherwise:
  /// the point it looks at, as deep in the picture as the middle of the box, and how far off it is.
  struct Placement {
    std::array<double, 3> target{};
    double distance = 0;
  };
  /// The box's middle from nowhere near where there are no points.
  Placement place() const;

 private:
  void extend(double x, double y, double z);
  /// Half of what the points take across (0) or up (1) at the depth, as the pyramid's planes have it.
  double half(std::size_t i, double depth) const;
  /// The middle of the points across or up in the picture of a camera so far off.
  double middle_at(std::size_t i, double distance, double depth) const;

  CameraAxes axes_;
  std::array<double, 2> slopes_;
  // Across and up: of the points moved along the pyramid's planes to depth 0, and of the points themselves.
  std::array<double, 2> low_, high_, flat_low_, flat_high_;
  double nearest_;
  BoundingBox bounds_;
};

}  // namespace tvg::player
