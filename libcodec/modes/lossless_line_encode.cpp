#include "modes/lossless_line_encode.hpp"

#include "base/bits.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <tvg/geometry.hpp>

namespace tvg {

namespace {

constexpr std::uint32_t kMagnitude = 0x7FFFFFFFu;
constexpr int kFractionBits = 23;

/// Which power of two the lowest bit of a float32 number stands for.
int step_exponent(std::uint32_t magnitude) {
  return std::max(static_cast<int>(magnitude >> kFractionBits), 1) + NumberLine::kLeastExponent - 1;
}

/// How many zero bits a number that is not zero ends with.
int zero_bits(std::uint32_t magnitude) {
  const std::uint32_t fraction = magnitude & ((1u << kFractionBits) - 1);
  return magnitude >> kFractionBits == 0 ? std::countr_zero(fraction)
                                         : std::countr_zero(fraction | 1u << kFractionBits);
}

/// What the coordinates of frames have in common.
struct Surveyed {
  std::uint32_t all_bits = 0;                ///< set in any
  std::uint32_t largest = 0;                 ///< magnitude
  int exponent = NumberLine::kMostExponent;  ///< all are multiples of this power of two
  double exponents = 0;  ///< sum of what the lowest bits stand for, of numbers that are not zero
  double count = 0;      ///< of those

  void add(float coordinate) {
    const std::uint32_t magnitude = bits_as<std::uint32_t>(coordinate) & kMagnitude;
    if (magnitude == 0) return;
    all_bits |= magnitude;
    largest = std::max(largest, magnitude);
    exponent = std::min(exponent, step_exponent(magnitude) + zero_bits(magnitude));
    exponents += step_exponent(magnitude);
    ++count;
  }

  LineChoice choose() const {
    const int low_bits = std::min(std::countr_zero(all_bits), NumberLine::kMostLowBits);
    const bool possible = value_of_float(largest) <= std::ldexp(NumberLine::kMostMultiple, exponent);
    const bool coarser = exponents + low_bits * count <= exponent * count;
    if (count > 0 && possible && coarser) return {.multiples = true, .low_bits = 0, .exponent = exponent};
    return {.multiples = false, .low_bits = low_bits, .exponent = 0};
  }
};

}  // namespace

LineChoice line_of(std::span<const FramePositions> frames) {
  Surveyed surveyed;
  for (const FramePositions& frame : frames) {
    for (const float coordinate : frame) surveyed.add(coordinate);
  }
  return surveyed.choose();
}

int lossless_shape_bits(std::span<const float> first_frame) {
  constexpr int kMost = 20;
  Surveyed surveyed;
  BoundingBox box;
  for (const float coordinate : first_frame) surveyed.add(coordinate);
  box.extend(first_frame);
  const LineChoice line = surveyed.choose();
  const int step = line.multiples ? line.exponent : step_exponent(surveyed.largest) + line.low_bits;
  const double steps = std::ldexp(box.largest_extent(), -step);
  if (!(steps >= 1)) return kMinBits;
  return std::clamp(std::ilogb(steps) + 2, kMinBits, kMost);
}

}  // namespace tvg
