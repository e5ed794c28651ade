#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include <tvg/types.hpp>

namespace tvg::player {

/// One way along one axis of the space of a sequence.
struct AxisDirection {
  std::size_t axis = 0;  ///< 0 x, 1 y, 2 z
  int sign = 1;          ///< 1 or -1

  std::array<double, 3> vector() const;
  friend bool operator==(const AxisDirection&, const AxisDirection&) = default;
};

/// "+X", "-y", "z" (which is +Z); nothing for anything else.
std::optional<AxisDirection> parse_axis_direction(const std::string& text);

/// How a sequence stands: what is up in it, and what looks at who stands before its front.
class Orientation {
 public:
  Orientation() = default;
  /// The front is what has x to its right, or y where x is up: +Z where y is up, -Y where z is.
  explicit Orientation(AxisDirection up);
  /// Throws std::invalid_argument where `up` and `front` lie along one axis.
  Orientation(AxisDirection up, AxisDirection front);

  AxisDirection up() const { return up_; }
  AxisDirection front() const { return front_; }
  /// What is at the right hand of who looks at the front.
  AxisDirection right() const;

 private:
  AxisDirection up_{1, 1};
  AxisDirection front_{2, 1};
};

/// The axis that is up by the metadata (`up`); y where they do not say.
AxisDirection up_of(const Metadata& metadata);

/// What the user has said of it; the rest is as a sequence's metadata say.
struct ChosenOrientation {
  std::optional<AxisDirection> up;
  std::optional<AxisDirection> front;

  /// Throws ToolError (kUsage) where up and front lie along one axis.
  Orientation of(const Metadata& metadata) const;
};

}  // namespace tvg::player
