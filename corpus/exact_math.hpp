#pragma once
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <random>

// Arithmetic that gives the same bits on every compiler and machine, so that corpus digests hold everywhere.
//
// The corpus computes in binary64 with + - * / and square roots only, which IEEE-754 defines to the last bit
// (floor, min and max are exact). Sines come from the polynomial below, never from libm, whose last bit
// differs between platforms. Random numbers are raw std::mt19937 output; the standard's distributions are not
// portable. tvg_compile_options() forbids contraction to fused multiply-add.
namespace tvg::corpus {

static_assert(FLT_EVAL_METHOD == 0,
              "the corpus needs plain binary64 arithmetic; on 32-bit x86 compile with -msse2 -mfpmath=sse");

/// sin(2 pi t), t in turns; absolute error below 1e-11.
inline double sine(double turns) {
  double t = turns - std::floor(turns + 0.5);
  if (t > 0.25) t = 0.5 - t;
  if (t < -0.25) t = -0.5 - t;
  const double x = t * 6.283185307179586;
  const double y = x * x;
  // Taylor series; its first term left out is (pi/2)^17 / 17!.
  double sum = -1.0 / 1307674368000.0;
  sum = sum * y + 1.0 / 6227020800.0;
  sum = sum * y - 1.0 / 39916800.0;
  sum = sum * y + 1.0 / 362880.0;
  sum = sum * y - 1.0 / 5040.0;
  sum = sum * y + 1.0 / 120.0;
  sum = sum * y - 1.0 / 6.0;
  return x + x * y * sum;
}

/// cos(2 pi t), t in turns.
inline double cosine(double turns) {
  return sine(turns + 0.25);
}

/// 0 below 0, 1 above 1, 3x^2 - 2x^3 between.
inline double smooth_step(double x) {
  const double c = std::clamp(x, 0.0, 1.0);
  return c * c * (3 - 2 * c);
}

/// A bell over [-1, 1]: 1 at 0, 0 with zero slope at both ends and beyond: (1 - x^2)^2.
inline double bell(double x) {
  const double rest = 1 - x * x;
  return rest > 0 ? rest * rest : 0.0;
}

struct Vec3 {
  double x = 0, y = 0, z = 0;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(double s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

/// `a` scaled to length 1; `a` must not be zero.
inline Vec3 normalized(const Vec3& a) {
  return 1 / length(a) * a;
}

/// A rigid motion: x -> rotation * x + translation.
struct Pose {
  Vec3 row_x{1, 0, 0}, row_y{0, 1, 0}, row_z{0, 0, 1};
  Vec3 translation;

  Vec3 turn(const Vec3& v) const { return {dot(row_x, v), dot(row_y, v), dot(row_z, v)}; }
  Vec3 apply(const Vec3& v) const { return turn(v) + translation; }

  /// The motion that does `inner` first, then this.
  Pose after(const Pose& inner) const;
};

/// Rotation by `turns` about the unit vector `axis` through `centre`, counter-clockwise seen from the axis'
/// tip.
Pose rotation_about(const Vec3& centre, const Vec3& axis, double turns);

/// Translation by `offset`.
inline Pose translation_by(const Vec3& offset) {
  Pose pose;
  pose.translation = offset;
  return pose;
}

/// Pseudo-random numbers, the same everywhere.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  /// A number in [0, 1), a multiple of 2^-32.
  double uniform() { return static_cast<double>(next()) / 4294967296.0; }
  /// An integer in [0, bound).
  std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>((std::uint64_t{next()} * bound) >> 32);
  }

 private:
  std::uint32_t next() { return static_cast<std::uint32_t>(engine_()); }

  std::mt19937 engine_;
};

}  // namespace tvg::corpus
