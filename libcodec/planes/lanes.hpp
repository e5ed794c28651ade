#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tvg {

/// One integer for each plane of a group of up to four planes; those beyond the group's planes are zero.
using Quad = std::array<std::int32_t, 4>;

/// Four integers that are computed with at once: in a vector register where the compiler has a type for it.
/// A comparison gives -1 where it holds and 0 where it does not. No result may leave 32 bits.
class Lanes {
 public:
  Lanes() = default;
  explicit Lanes(const Quad& quad) { std::memcpy(&lanes_, &quad, sizeof lanes_); }
  /// From numbers that do not lie side by side in memory, where reading them at once would have to wait for
  /// them.
  Lanes(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) : lanes_{a, b, c, d} {}
  /// The same in every lane.
  static Lanes all(std::int32_t value) { return Lanes(value, value, value, value); }

  std::int32_t operator[](std::size_t lane) const { return lanes_[lane]; }
  Quad quad() const {
    Quad quad;
    std::memcpy(&quad, &lanes_, sizeof quad);
    return quad;
  }

#if defined(__GNUC__) && !defined(TVG_PLAIN_LANES)
  friend Lanes operator+(Lanes a, Lanes b) {
    return Lanes(a.lanes_ + b.lanes_);
  }
  friend Lanes operator-(Lanes a, Lanes b) {
    return Lanes(a.lanes_ - b.lanes_);
  }
  friend Lanes operator*(Lanes a, Lanes b) {
    return Lanes(a.lanes_ * b.lanes_);
  }
  friend Lanes operator&(Lanes a, Lanes b) {
    return Lanes(a.lanes_ & b.lanes_);
  }
  friend Lanes operator^(Lanes a, Lanes b) {
    return Lanes(a.lanes_ ^ b.lanes_);
  }
  friend Lanes operator|(Lanes a, Lanes b) {
    return Lanes(a.lanes_ | b.lanes_);
  }
  friend Lanes operator<<(Lanes a, int bits) {
    return Lanes(a.lanes_ << bits);
  }
  friend Lanes operator>>(Lanes a, int bits) {
    return Lanes(a.lanes_ >> bits);
  }
  friend Lanes operator>(Lanes a, Lanes b) {
    return Lanes(a.lanes_ > b.lanes_);
  }
  friend Lanes operator>(Lanes a, std::int32_t b) {
    return Lanes(a.lanes_ > b);
  }
  friend Lanes operator<(Lanes a, std::int32_t b) {
    return Lanes(a.lanes_ < b);
  }
  friend bool any(Lanes a) {
    using Halves [[gnu::vector_size(sizeof(Quad))]] = std::int64_t;
    const auto halves = reinterpret_cast<Halves>(a.lanes_);
    return (halves[0] | halves[1]) != 0;
  }

 private:
  using Vector [[gnu::vector_size(sizeof(Quad))]] = std::int32_t;
  explicit Lanes(Vector lanes) : lanes_(lanes) {}

  Vector lanes_{};
#else
  friend Lanes operator+(Lanes a, Lanes b) {
    return each([&](std::size_t i) { return a[i] + b[i]; });
  }
  friend Lanes operator-(Lanes a, Lanes b) {
    return each([&](std::size_t i) { return a[i] - b[i]; });
  }
  friend Lanes operator*(Lanes a, Lanes b) {
    return each([&](std::size_t i) { return a[i] * b[i]; });
  }
  friend Lanes operator&(Lanes a, Lanes b) {
    return each([&](std::size_t i) { return a[i] & b[i]; });
  }
  friend Lanes operator^(Lanes a, Lanes b) {
    return each([&](std::size_t i) { return a[i] ^ b[i]; });
  }
  friend Lanes operator|(Lanes a, Lanes b) {
    return each([&](std::size_t i) { return a[i] | b[i]; });
  }
  friend Lanes operator<<(Lanes a, int bits) {
    return each([&](std::size_t i) { return a[i] << bits; });
  }
  friend Lanes operator>>(Lanes a, int bits) {
    return each([&](std::size_t i) { return a[i] >> bits; });
  }
  friend Lanes operator>(Lanes a, Lanes b) {
    return each([&](std::size_t i) { return a[i] > b[i] ? -1 : 0; });
  }
  friend Lanes operator>(Lanes a, std::int32_t b) {
    return each([&](std::size_t i) { return a[i] > b ? -1 : 0; });
  }
  friend Lanes operator<(Lanes a, std::int32_t b) {
    return each([&](std::size_t i) { return a[i] < b ? -1 : 0; });
  }
  friend bool any(Lanes a) {
    return (a[0] | a[1] | a[2] | a[3]) != 0;
  }

 private:
  template <class Lane>
  static Lanes each(const Lane& lane) {
    return Lanes(Quad{lane(0), lane(1), lane(2), lane(3)});
  }

  Quad lanes_{};
#endif
};

/// Sums, which every instruction set has.
inline Lanes twice(Lanes x) {
  return x + x;
}
inline Lanes thrice(Lanes x) {
  return x + x + x;
}

inline Lanes abs(Lanes x) {
  const Lanes sign = x >> 31;
  return (x ^ sign) - sign;
}

inline std::int32_t sum_of(Lanes x) {
  return x[0] + x[1] + x[2] + x[3];
}

/// The smaller and the larger of two, lane by lane.
inline Lanes min(Lanes a, Lanes b) {
  const Lanes above = a > b;
  return a ^ ((a ^ b) & above);
}
inline Lanes max(Lanes a, Lanes b) {
  const Lanes above = a > b;
  return b ^ ((a ^ b) & above);
}

/// Halves that are rounded towards zero.
inline Lanes half(Lanes x) {
  return (x - (x >> 31)) >> 1;
}

/// What lies beyond -kLargest or kLargest is brought there.
template <std::int32_t kLargest>
Lanes clamp(Lanes x) {
  if constexpr (kLargest <= 2) {  // a sum of comparisons is less than two choices where SSE2 is all there is
    Lanes sum = (x < 0) - (x > 0);
    if constexpr (kLargest == 2) sum = sum + (x < -1) - (x > 1);
    return sum;
  } else {
    const Lanes above = x > kLargest, below = x < -kLargest;
    const Lanes inside = Lanes::all(-1) ^ above ^ below;
    return (x & inside) + (Lanes::all(kLargest) & above) - (Lanes::all(kLargest) & below);
  }
}

}  // namespace tvg
