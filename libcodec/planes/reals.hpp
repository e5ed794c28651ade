#pragma once
#include "base/bits.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tvg {

/// A real number for each axis, and a fourth that is zero, which are computed with at once: in vector
/// registers where the compiler has a type for them. Either way each operation is rounded as binary64 is.
class Reals {
 public:
  Reals() = default;
  Reals(double a, double b, double c, double d) : low_{a, b}, high_{c, d} {}
  /// The same for all.
  static Reals all(double value) { return {value, value, value, value}; }

  double operator[](std::size_t lane) const { return lane < 2 ? low_[lane] : high_[lane - 2]; }

#if defined(__GNUC__) && !defined(TVG_PLAIN_LANES)
  friend Reals operator+(Reals a, Reals b) {
    return {a.low_ + b.low_, a.high_ + b.high_};
  }
  friend Reals operator-(Reals a, Reals b) {
    return {a.low_ - b.low_, a.high_ - b.high_};
  }
  friend Reals operator*(Reals a, Reals b) {
    return {a.low_ * b.low_, a.high_ * b.high_};
  }
  friend Reals operator/(Reals a, Reals b) {
    return {a.low_ / b.low_, a.high_ / b.high_};
  }
  friend Reals abs(Reals x) {
    return {abs(x.low_), abs(x.high_)};
  }

 private:
  using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;
  using Bits [[gnu::vector_size(2 * sizeof(double))]] = std::int64_t;

  static Pair abs(Pair x) {
    return bits_as<Pair>(bits_as<Bits>(x) & 0x7FFFFFFFFFFFFFFF);
  }
#else
  friend Reals operator+(Reals a, Reals b) {
    return each([&](std::size_t i) { return a[i] + b[i]; });
  }
  friend Reals operator-(Reals a, Reals b) {
    return each([&](std::size_t i) { return a[i] - b[i]; });
  }
  friend Reals operator*(Reals a, Reals b) {
    return each([&](std::size_t i) { return a[i] * b[i]; });
  }
  friend Reals operator/(Reals a, Reals b) {
    return each([&](std::size_t i) { return a[i] / b[i]; });
  }
  friend Reals abs(Reals x) {
    return each([&](std::size_t i) { return x[i] < 0 ? -x[i] : x[i]; });
  }

 private:
  using Pair = std::array<double, 2>;

  template <class Lane>
  static Reals each(const Lane& lane) {
    return {lane(0), lane(1), lane(2), lane(3)};
  }
#endif

  Reals(Pair low, Pair high) : low_(low), high_(high) {}

  Pair low_{}, high_{};
};

}  // namespace tvg
