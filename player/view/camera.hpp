#pragma once
#include "player/view/orientation.hpp"
#include "player/view/view_extent.hpp"

#include <array>
#include <string>

namespace tvg::player {

/// A rectangle of a framebuffer in pixels, from its lower left corner.
struct Viewport {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  double aspect() const { return height > 0 ? static_cast<double>(width) / height : 1; }
};

/// Where a camera stands, in degrees around the middle of what is shown. Azimuth 0 looks at the front, 90 at
/// the right side; elevation 90 looks straight down.
struct ViewAngles {
  double azimuth = 30;
  double elevation = 15;
  double zoom = 1;  ///< 2 shows everything at twice the size
};

/// "front", "back", "left", "right", "top", "bottom", "iso", or "azimuth,elevation[,zoom]" in degrees. Throws
/// ToolError (kUsage) that shows these.
ViewAngles parse_view(const std::string& text);

/// What shaders need of a camera. Matrices are column-major.
struct CameraMatrices {
  std::array<float, 16> view;
  std::array<float, 16> projection;
};

/// A perspective camera on a sphere around the middle of what is shown.
class OrbitCamera {
 public:
  void set_angles(const ViewAngles& angles);
  const ViewAngles& angles() const { return angles_; }
  void set_orientation(const Orientation& orientation) { orientation_ = orientation; }
  const Orientation& orientation() const { return orientation_; }

  CameraAxes axes() const;
  /// To be shown what fit() is to take in, in a picture of this aspect, as long as angles and orientation
  /// stay.
  ViewExtent extent(double aspect) const;
  /// Stands so that at zoom 1 the points of an extent fill the picture but for a small margin. Angles and
  /// zoom stay, panning is undone.
  void fit(const ViewExtent& extent);

  /// Moves around the middle by degrees; elevation stops at the poles.
  void orbit(double azimuth, double elevation);
  /// Moves the picture by shares of its height: right and up are positive.
  void pan(double right, double up);
  /// Multiplies the zoom by `factor`, within bounds of usefulness.
  void zoom_by(double factor);

  CameraMatrices matrices(double aspect) const;

 private:
  double distance() const { return fitted_distance_ / angles_.zoom; }

  ViewAngles angles_;
  Orientation orientation_;
  std::array<double, 3> center_{};  // of the bounding sphere
  std::array<double, 3> target_{};
  double radius_ = 1;
  double fitted_distance_ = 1;
};

}  // namespace tvg::player
