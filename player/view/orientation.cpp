#include "player/view/orientation.hpp"

#include "tool/tool_error.hpp"

#include <fmt/format.h>
#include <stdexcept>

namespace tvg::player {

namespace {

constexpr const char* kAxisNames = "XYZ";

AxisDirection cross(const AxisDirection& a, const AxisDirection& b) {
  const bool in_turn = (a.axis + 1) % 3 == b.axis;
  return {3 - a.axis - b.axis, a.sign * b.sign * (in_turn ? 1 : -1)};
}

std::string name_of(const AxisDirection& direction) {
  return fmt::format("{}{}", direction.sign > 0 ? '+' : '-', kAxisNames[direction.axis]);
}

}  // namespace

std::array<double, 3> AxisDirection::vector() const {
  std::array<double, 3> result{};
  result[axis] = sign;
  return result;
}

std::optional<AxisDirection> parse_axis_direction(const std::string& text) {
  const bool is_signed = !text.empty() && (text[0] == '+' || text[0] == '-');
  if (text.size() != (is_signed ? 2U : 1U)) return std::nullopt;
  const char letter = text.back();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (letter == kAxisNames[axis] || letter == kAxisNames[axis] - 'A' + 'a')
      return AxisDirection{axis, text[0] == '-' ? -1 : 1};
  }
  return std::nullopt;
}

Orientation::Orientation(AxisDirection up)
    : Orientation(up, cross({up.axis == 0 ? std::size_t{1} : std::size_t{0}, 1}, up)) {}

Orientation::Orientation(AxisDirection up, AxisDirection front) : up_(up), front_(front) {
  if (up.axis == front.axis) throw std::invalid_argument("up and front lie along one axis");
}

AxisDirection Orientation::right() const {
  return cross(up_, front_);
}

AxisDirection up_of(const Metadata& metadata) {
  const auto up = metadata.find("up");
  const std::optional<AxisDirection> said =
      up != metadata.end() ? parse_axis_direction(up->second) : std::nullopt;
  return said.value_or(AxisDirection{1, 1});
}

Orientation ChosenOrientation::of(const Metadata& metadata) const {
  const AxisDirection upwards = up.value_or(up_of(metadata));
  if (!front) return Orientation(upwards);
  if (front->axis == upwards.axis) {
    throw cli::ToolError(cli::ExitStatus::kUsage,
                         fmt::format("--front {}: {} is up: name another axis, or what is up with --up",
                                     name_of(*front), name_of(upwards)));
  }
  return {upwards, *front};
}

}  // namespace tvg::player
