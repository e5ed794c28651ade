#include "metrics/attribute_difference.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace tvg {

namespace {

float component(AttributeKind kind, std::span<const float> value, std::size_t index) {
  if (index < value.size()) return value[index];
  return kind == AttributeKind::kColour && index == 3 ? 1.0f : 0.0f;
}

double difference_of(float a, float b) {
  if (std::isfinite(a) && std::isfinite(b)) return std::abs(double{a} - double{b});
  const bool same = std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
  return same ? 0 : std::numeric_limits<double>::infinity();
}

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// In degrees, precise for small angles too.
double angle_between(const Vector& a, const Vector& b) {
  const bool none_of_a = dot(a, a) == 0, none_of_b = dot(b, b) == 0;
  if (none_of_a || none_of_b) return none_of_a == none_of_b ? 0 : 180;
  const Vector cross = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return std::atan2(std::sqrt(dot(cross, cross)), dot(a, b)) * 180 / std::numbers::pi;
}

}  // namespace

void DifferenceSum::add(std::span<const float> original, std::span<const float> decoded) {
  ++values_;
  const std::size_t components = std::max(original.size(), decoded.size());
  if (kind_ == AttributeKind::kNormal && components == 3) {
    Vector a{}, b{};
    bool finite = true;
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = component(kind_, original, i);
      b[i] = component(kind_, decoded, i);
      finite = finite && std::isfinite(a[i]) && std::isfinite(b[i]);
    }
    if (finite) {
      add_difference(angle_between(a, b));
      return;
    }
    add_difference(std::equal(original.begin(), original.end(), decoded.begin(), decoded.end(),
                              [](float x, float y) { return difference_of(x, y) == 0; })
                       ? 0
                       : std::numeric_limits<double>::infinity());
    return;
  }
  for (std::size_t i = 0; i < components; ++i)
    add_difference(difference_of(component(kind_, original, i), component(kind_, decoded, i)));
}

void DifferenceSum::add_difference(double difference) {
  ++numbers_;
  max_ = std::max(max_, difference);
  sum_ += difference;
  squares_ += difference * difference;
}

void DifferenceSum::give(AttributeDifference& difference) const {
  difference.values = values_;
  if (numbers_ == 0) return;
  const double numbers = static_cast<double>(numbers_);
  difference.max_difference = max_;
  difference.rms_difference = std::sqrt(squares_ / numbers);
  difference.mean_difference = sum_ / numbers;
}

}  // namespace tvg
