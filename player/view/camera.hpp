#pragma once
#include "player/view/bounds.hpp"

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
  /// Takes in what is shown: the distance is such that its bounding sphere fits at zoom 1, from everywhere.
  /// Angles and zoom stay, panning is undone.
  void fit(const BoundingBox& bounds, UpAxis up);
  /// fit(), then nearer and to the side until the box itself fills most of a picture of this aspect from the
  /// present angles at zoom 1.
  void fit_closely(const BoundingBox& bounds, UpAxis up, double aspect);

  void set_angles(const ViewAngles& angles);
  const ViewAngles& angles() const { return angles_; }
  UpAxis up() const { return up_; }

  /// Moves around the middle by degrees; elevation stops at the poles.
  void orbit(double azimuth, double elevation);
  /// Moves the picture by shares of its height: right and up are positive.
  void pan(double right, double up);
  /// Multiplies the zoom by `factor`, within bounds of usefulness.
  void zoom_by(double factor);

  CameraMatrices matrices(double aspect) const;

 private:
  struct Axes;  // right, up and backward in the space of the sequence
  Axes axes() const;
  double distance(double aspect) const;

  ViewAngles angles_;
  UpAxis up_ = UpAxis::kY;
  std::array<double, 3> center_{};  // of the bounding sphere
  std::array<double, 3> target_{};
  double radius_ = 1;
  double fitted_distance_ = 0;  // 0: as the bounding sphere needs it
};

}  // namespace tvg::player
