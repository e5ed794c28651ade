#include "player/view/camera.hpp"

#include "tool/tool_error.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

namespace tvg::player {

namespace {

using Eigen::Vector3d;

constexpr double kFieldOfView =
    30 * std::numbers::pi / 180;  // vertical; little distortion, as portraits have
constexpr double kMargin = 1.06;
constexpr double kMostZoom = 500;

constexpr std::array<std::pair<std::string_view, ViewAngles>, 7> kNamedViews = {{
    {"front", {0, 0}},
    {"back", {180, 0}},
    {"left", {-90, 0}},
    {"right", {90, 0}},
    {"top", {0, 90}},
    {"bottom", {0, -90}},
    {"iso", {45, 35.264}},
}};

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

Vector3d vector(const std::array<double, 3>& values) {
  return Eigen::Map<const Vector3d>(values.data());
}

std::array<double, 3> array(const Vector3d& values) {
  return {values.x(), values.y(), values.z()};
}

/// The next number of a list with commas; `text` loses it.
std::optional<double> next_number(std::string_view& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (text.starts_with(',') && text.size() > 1) {
    text.remove_prefix(1);
  } else if (!text.empty()) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

ViewAngles parse_view(const std::string& text) {
  for (const auto& [name, angles] : kNamedViews) {
    if (text == name) return angles;
  }
  std::string_view rest = text;
  const std::optional<double> azimuth = next_number(rest);
  const std::optional<double> elevation = azimuth ? next_number(rest) : std::nullopt;
  const std::optional<double> zoom = rest.empty() ? 1.0 : next_number(rest);
  if (!azimuth || !elevation || !zoom || !rest.empty() || std::abs(*elevation) > 90 || !(*zoom > 0) ||
      *zoom > kMostZoom) {
    throw cli::ToolError(
        cli::ExitStatus::kUsage,
        fmt::format("--camera {}: write front, back, left, right, top, bottom, iso, or azimuth, "
                    "elevation (-90 to 90) and, if wanted, zoom (up to {}) as 30,15 or 30,15,1.5",
                    text, kMostZoom));
  }
  return {std::remainder(*azimuth, 360), *elevation, *zoom};
}

struct OrbitCamera::Axes {
  Vector3d right, up, backward;
};

OrbitCamera::Axes OrbitCamera::axes() const {
  const double azimuth = radians(angles_.azimuth);
  const double elevation = radians(angles_.elevation);
  // For y up; z up is the same turned by a quarter about x, so that the front still looks along the ground.
  Axes axes{{std::cos(azimuth), 0, -std::sin(azimuth)},
            {},
            {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
             std::cos(azimuth) * std::cos(elevation)}};
  axes.up = axes.backward.cross(axes.right);
  if (up_ == UpAxis::kZ) {
    for (Vector3d* axis : {&axes.right, &axes.up, &axes.backward}) {
      *axis = Vector3d(axis->x(), -axis->z(), axis->y());
    }
  }
  return axes;
}

void OrbitCamera::fit(const BoundingBox& bounds, UpAxis up) {
  up_ = up;
  center_ = target_ = bounds.center();
  radius_ = view_radius(bounds);
  fitted_distance_ = 0;
}

void OrbitCamera::fit_closely(const BoundingBox& bounds, UpAxis up, double aspect) {
  fit(bounds, up);
  const Axes at = axes();
  const double slope_y = std::tan(kFieldOfView / 2) / kMargin;
  const double slope_x = slope_y * aspect;
  const Vector3d center = vector(center_);
  // A corner (x, y, z) seen from the distance d is in the picture where |x - x0| <= slope * (d - z); the two
  // planes that bound it on either side give the middle and the distance.
  Eigen::Vector2d low(INFINITY, INFINITY);
  Eigen::Vector2d high(-INFINITY, -INFINITY);
  double nearest = -INFINITY;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d point = Vector3d((corner & 1) != 0 ? bounds.high()[0] : bounds.low()[0],
                                    (corner & 2) != 0 ? bounds.high()[1] : bounds.low()[1],
                                    (corner & 4) != 0 ? bounds.high()[2] : bounds.low()[2]) -
                           center;
    const double z = point.dot(at.backward);
    const Eigen::Vector2d on_screen(point.dot(at.right), point.dot(at.up));
    const Eigen::Vector2d reach(slope_x * z, slope_y * z);
    low = low.cwiseMin(on_screen - reach);
    high = high.cwiseMax(on_screen + reach);
    nearest = std::max(nearest, z);
  }
  const Eigen::Vector2d middle = (low + high) / 2;
  const Eigen::Vector2d half = (high - low) / 2;
  target_ = array(center + middle.x() * at.right + middle.y() * at.up);
  fitted_distance_ = std::max({half.x() / slope_x, half.y() / slope_y, nearest + radius_ / 20});
}

void OrbitCamera::set_angles(const ViewAngles& angles) {
  angles_ = angles;
}

void OrbitCamera::orbit(double azimuth, double elevation) {
  angles_.azimuth = std::remainder(angles_.azimuth + azimuth, 360);
  angles_.elevation = std::clamp(angles_.elevation + elevation, -90.0, 90.0);
}

void OrbitCamera::pan(double right, double up) {
  const Axes at = axes();
  const double height = 2 * std::tan(kFieldOfView / 2) * distance(1);
  target_ = array(vector(target_) - height * (right * at.right + up * at.up));
}

void OrbitCamera::zoom_by(double factor) {
  angles_.zoom = std::clamp(angles_.zoom * factor, 1 / kMostZoom, kMostZoom);
}

double OrbitCamera::distance(double aspect) const {
  if (fitted_distance_ > 0) return fitted_distance_ / angles_.zoom;
  const double narrow = std::atan(std::tan(kFieldOfView / 2) * std::min(1.0, aspect));
  return kMargin * radius_ / std::sin(narrow) / angles_.zoom;
}

CameraMatrices OrbitCamera::matrices(double aspect) const {
  const Axes at = axes();
  const double away = distance(aspect);
  const Vector3d eye = vector(target_) + away * at.backward;
  CameraMatrices result{};
  Eigen::Map<Eigen::Matrix4f> view(result.view.data());
  view.setIdentity();
  view.block<1, 3>(0, 0) = at.right.cast<float>();
  view.block<1, 3>(1, 0) = at.up.cast<float>();
  view.block<1, 3>(2, 0) = at.backward.cast<float>();
  view.block<3, 1>(0, 3) = -Vector3d(at.right.dot(eye), at.up.dot(eye), at.backward.dot(eye)).cast<float>();

  const double to_center = (eye - vector(center_)).norm();
  const double far = to_center + 8 * radius_;  // the grid reaches beyond the box
  const double near = std::max({to_center - 2.5 * radius_, 0.02 * away, far / 1e5});
  const double slope = std::tan(kFieldOfView / 2);
  Eigen::Map<Eigen::Matrix4f> projection(result.projection.data());
  projection.setZero();
  projection(0, 0) = static_cast<float>(1 / (slope * aspect));
  projection(1, 1) = static_cast<float>(1 / slope);
  projection(2, 2) = static_cast<float>((far + near) / (near - far));
  projection(2, 3) = static_cast<float>(2 * far * near / (near - far));
  projection(3, 2) = -1;
  return result;
}

}  // namespace tvg::player
