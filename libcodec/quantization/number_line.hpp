#pragma once
#include "base/bits.hpp"

#include <algorithm>
#include <cstdint>

// Float32 numbers in their order (format-spec §7.9.1): each has a whole number, neighbours differ by one, and
// real numbers lie between them. Nothing here depends on what a processor is set to do with denormal numbers.
namespace tvg {

/// A float32 number as an integer: in the order of the numbers, -0 next to 0.
inline std::int32_t ordered(std::uint32_t float_bits) {
  const auto magnitude = static_cast<std::int32_t>(float_bits & 0x7FFFFFFFu);
  return float_bits >> 31 != 0 ? -1 - magnitude : magnitude;
}

/// The value of a finite float32 number from its bits.
inline double value_of_float(std::uint32_t float_bits) {
  const std::uint32_t magnitude = float_bits & 0x7FFFFFFFu;
  const double size = magnitude < (1u << 23)
                          ? magnitude * 0x1p-149
                          : bits_as<double>((std::uint64_t{magnitude} << 29) + (std::uint64_t{896} << 52));
  return float_bits >> 31 != 0 ? -size : size;
}

/// The bits of a value that is a float32 number.
inline std::uint32_t float_of_value(double value) {
  const auto bits = bits_as<std::uint64_t>(value);
  const double size = bits_as<double>(bits & ~(std::uint64_t{1} << 63));
  const std::uint32_t magnitude =
      size < 0x1p-126
          ? static_cast<std::uint32_t>(size * 0x1p149)
          : static_cast<std::uint32_t>((bits_as<std::uint64_t>(size) - (std::uint64_t{896} << 52)) >> 29);
  return static_cast<std::uint32_t>(bits >> 63 << 31) | magnitude;
}

/// 16 log2 of a number without its sign, nearly, and 16 * 1023 above it; 0 for zero.
inline std::int32_t log_sixteenths(double value) {
  return static_cast<std::int32_t>(bits_as<std::uint64_t>(value) >> 48 & 0x7FFF);
}

/// The numbers a GOP may have: all float32 numbers whose lowest bits are zero, or the multiples of a power of
/// two. A number's place on the line is its magnitude in steps, or one less than that with the other sign
/// where it is negative: both zeros have a place.
class NumberLine {
 public:
  static constexpr int kFractionBits = 6;  ///< places of real numbers are in 1/64 of a step
  static constexpr int kMostLowBits = 23;
  static constexpr int kLeastExponent = -149;
  static constexpr int kMostExponent = 103;
  static constexpr std::int32_t kMostMultiple = 1 << 24;

  /// Float32 numbers whose so many lowest bits are zero, 0 to kMostLowBits.
  static NumberLine of_floats(int low_bits) { return {low_bits, 1, 1, std::int32_t{0x7F7FFFFF} >> low_bits}; }
  /// Multiples of 2^exponent, kLeastExponent to kMostExponent, up to kMostMultiple of them.
  static NumberLine of_multiples(int exponent) {
    return {kMultiples, power_of_two(exponent), power_of_two(kFractionBits - exponent), kMostMultiple};
  }

  /// The magnitude of the last place on either side.
  std::int32_t most() const { return most_; }

  /// The place of a value that is on the line.
  std::int32_t place_of(double value) const {
    const std::int32_t number = ordered(float_of_value(value));
    const std::int32_t magnitude = number < 0 ? -1 - number : number;
    const std::int32_t place =
        low_bits_ >= 0 ? magnitude >> low_bits_
                       : static_cast<std::int32_t>((number < 0 ? -value : value) * scale_) >> kFractionBits;
    return number < 0 ? -1 - place : place;
  }

  /// The value at a place that is on the line.
  double value_at(std::int32_t place) const {
    const std::int32_t magnitude = place < 0 ? -1 - place : place;
    const double size = low_bits_ >= 0 ? value_of_float(static_cast<std::uint32_t>(magnitude) << low_bits_)
                                       : magnitude * step_;
    return place < 0 ? -size : size;
  }

  /// The place of a real number of less than 2^200, in 1/64 of a step; where the line ends before it, its
  /// end.
  std::int64_t place_between(double value) const {
    const double size = value < 0 ? -value : value;
    const std::int64_t most = std::int64_t{most_} << kFractionBits;
    std::int64_t magnitude = 0;
    if (low_bits_ == kMultiples) {
      magnitude = static_cast<std::int64_t>(std::min(size * scale_, static_cast<double>(most)));
    } else if (size < 0x1p-126) {
      magnitude = static_cast<std::int64_t>(size * 0x1p155) >> low_bits_;
    } else {
      const std::uint64_t fine = bits_as<std::uint64_t>(size) - (std::uint64_t{896} << 52);
      magnitude = std::min(static_cast<std::int64_t>(fine >> (29 - kFractionBits)) >> low_bits_, most);
    }
    return value < 0 ? -(1 << kFractionBits) - magnitude : magnitude;
  }

  /// log_sixteenths() of the step at a real number.
  std::int32_t log_step(double value) const {
    if (low_bits_ == kMultiples) return log_sixteenths(step_);
    const auto exponent = static_cast<std::int32_t>(bits_as<std::uint64_t>(value) >> 52 & 0x7FF);
    return (std::max(exponent, 1023 - 126) - 23 + low_bits_) << 4;
  }

 private:
  static constexpr int kMultiples = -1;

  NumberLine(int low_bits, double step, double scale, std::int32_t most)
      : low_bits_(low_bits), most_(most), step_(step), scale_(scale) {}

  static double power_of_two(int exponent) {
    return bits_as<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
  }

  int low_bits_;       ///< that are zero, or kMultiples
  std::int32_t most_;  ///< magnitude
  double step_;        ///< of multiples
  double scale_;       ///< 1/64 steps of multiples to a unit
};

}  // namespace tvg
