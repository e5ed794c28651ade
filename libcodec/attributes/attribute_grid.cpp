#include "attributes/attribute_grid.hpp"

#include "base/bits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace tvg {

namespace {

/// The unit vector at a place of the octahedron, which is unfolded into a square (format-spec §5.7.1).
void unfold(std::int32_t s, std::int32_t t, std::int32_t centre, std::span<float> normal) {
  std::int32_t y = s - centre, z = t - centre;
  const std::int32_t x = centre - std::abs(y) - std::abs(z);
  const std::int32_t beyond = x < 0 ? -x : 0;
  y += y < 0 ? beyond : -beyond;
  z += z < 0 ? beyond : -beyond;
  const auto square = [](std::int32_t n) { return static_cast<double>(std::int64_t{n} * n); };
  const double length = std::sqrt(square(x) + square(y) + square(z));
  normal[0] = static_cast<float>(x / length);
  normal[1] = static_cast<float>(y / length);
  normal[2] = static_cast<float>(z / length);
}

}  // namespace

// format-spec §5.7.1
void AttributeGrid::value_of(std::span<const std::int32_t> integers, std::span<float> value) const {
  if (octahedral()) {
    if (integers[0] == none()) {
      value[0] = value[1] = value[2] = 0;
    } else {
      unfold(integers[0], integers[1], largest() / 2, value);
    }
    return;
  }
  for (std::size_t c = 0; c < components; ++c) {
    value[c] =
        stepped() ? finite_float(origin[c] + integers[c] * range / largest()) : ordered_number(integers[c]);
  }
}

std::int32_t ordered_integer(float number) {
  const auto bits = bits_as<std::uint32_t>(number);
  return static_cast<std::int32_t>(bits < 0x80000000u ? bits : 0x7FFFFFFFu - bits);
}

float ordered_number(std::int32_t integer) {
  const auto bits = static_cast<std::uint32_t>(integer);
  return bits_as<float>(integer >= 0 ? bits : 0x7FFFFFFFu - bits);
}

bool is_finite_number(std::int32_t integer) {
  constexpr std::int32_t kMost = 0x7F7FFFFF;
  return integer <= kMost && integer >= -1 - kMost;
}

float finite_float(double number) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(number, -kLargest, kLargest));
}

}  // namespace tvg
