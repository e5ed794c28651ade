#include "player/view/camera.hpp"

#include "player/view/bounds.hpp"
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
constexpr double kMargin = 1.06;  // what the picture has of what is shown
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

CameraAxes OrbitCamera::axes() const {
  const double azimuth = radians(angles_.azimuth);
  const double elevation = radians(angles_.elevation);
  const Vector3d to_right = vector(orientation_.right().vector());
  const Vector3d to_front = vector(orientation_.front().vector());
  const Vector3d upwards = vector(orientation_.up().vector());
  const Vector3d right = std::cos(azimuth) * to_right - std::sin(azimuth) * to_front;
  const Vector3d backward =
      std::cos(elevation) * (std::sin(azimuth) * to_right + std::cos(azimuth) * to_front) +
      std::sin(elevation) * upwards;
  return {array(right), array(backward.cross(right)), array(backward)};
}

ViewExtent OrbitCamera::extent(double aspect) const {
  const double slope = std::tan(kFieldOfView / 2) / kMargin;
  return {axes(), slope * aspect, slope};
}

void OrbitCamera::fit(const ViewExtent& extent) {
  center_ = extent.bounds().center();
  radius_ = view_radius(extent.bounds());
  const ViewExtent::Placement placement = extent.place();
  target_ = placement.target;
  fitted_distance_ = placement.distance;
}

void OrbitCamera::set_angles(const ViewAngles& angles) {
  angles_ = angles;
}

void OrbitCamera::orbit(double azimuth, double elevation) {
  angles_.azimuth = std::remainder(angles_.azimuth + azimuth, 360);
  angles_.elevation = std::clamp(angles_.elevation + elevation, -90.0, 90.0);
}

void OrbitCamera::pan(double right, double up) {
  const CameraAxes at = axes();
  const double height = 2 * std::tan(kFieldOfView / 2) * distance();
  target_ = array(vector(target_) - height * (right * vector(at.right) + up * vector(at.up)));
}

void OrbitCamera::zoom_by(double factor) {
  angles_.zoom = std::clamp(angles_.zoom * factor, 1 / kMostZoom, kMostZoom);
}

CameraMatrices OrbitCamera::matrices(double aspect) const {
  const CameraAxes at = axes();
  const double away = distance();
  const Vector3d eye = vector(target_) + away * vector(at.backward);
  CameraMatrices result{};
  Eigen::Map<Eigen::Matrix4f> view(result.view.data());
  view.setIdentity();
  Eigen::Index row = 0;
  for (const std::array<double, 3>& axis : {at.right, at.up, at.backward}) {
    view.block<1, 3>(row, 0) = vector(axis).transpose().cast<float>();
    view(row++, 3) = static_cast<float>(-vector(axis).dot(eye));
  }

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
