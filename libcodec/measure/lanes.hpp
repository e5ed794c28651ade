#pragma once
#include <Eigen/Core>
#include <array>
#include <numbers>

// The same value of a few frames side by side: what is computed alike in each frame is computed for all of
// them at once, one to a lane of the processor's vectors. Results do not depend on what other lanes hold.
namespace tvg {

inline constexpr int kLanes = 2;
using Lanes = Eigen::Array<double, kLanes, 1>;
using Point = std::array<Lanes, 3>;

inline Lanes dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Point times(const Lanes& s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}

inline void add(Point& sum, const Point& a) {
  for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += a[axis];
}

/// The same number in every lane, ready in memory: kept in a register each would push out what is computed.
class Same {
 public:
  explicit constexpr Same(double x) { lanes_.fill(x); }

  Eigen::Map<const Lanes, Eigen::Aligned16> operator()() const {
    return Eigen::Map<const Lanes, Eigen::Aligned16>(lanes_.data());
  }

 private:
  alignas(16) std::array<double, kLanes> lanes_{};
};

/// -1, 0 or 1 in each lane. Vectors have no branches: one multiplies by this to choose. Values nearer to zero
/// than 1e-300 are not told from it properly; products of coordinates, which are floats, are not that small.
EIGEN_ALWAYS_INLINE Lanes sign_of(const Lanes& x) {
  static constexpr Same kHuge(1e300), kOne(1), kMinusOne(-1);
  return (x * kHuge()).max(kMinusOne()).min(kOne());
}

/// The angle from the x axis to (x, y), y > 0: atan2(y, x), in [0, pi], off by a few roundings of pi.
/// `x_sign` is that of x.
EIGEN_ALWAYS_INLINE Lanes angle_to(const Lanes& x, const Lanes& x_sign, const Lanes& y) {
  using std::numbers::pi;
  // atan w = w p(w^2), where p, of these terms, interpolates at Chebyshev nodes for |w| <= tan(pi / 8), off
  // by 4e-17 at most.
  static constexpr std::array kTerms = {Same(1.0),
                                        Same(-0.3333333333332844),
                                        Same(0.1999999999885511),
                                        Same(-0.14285714180976467),
                                        Same(0.11111106180455946),
                                        Same(-0.09090773074808414),
                                        Same(0.07689953496306857),
                                        Same(-0.06640233930429408),
                                        Same(0.056883492268090106),
                                        Same(-0.04348052215716462),
                                        Same(0.021135373157693246)};
  static constexpr Same kTan(std::numbers::sqrt2 - 1), kEighth(pi / 8), kQuarter(pi / 4), kHalf(pi / 2);
  // The smaller of |x| and y over the larger is the tangent of pi / 8 + atan w.
  const Lanes width = x * x_sign;
  const Lanes low = width.min(y), high = width.max(y);
  const Lanes w = (low - high * kTan()) / (low * kTan() + high);
  const Lanes z = w * w, z2 = z * z, z4 = z2 * z2;
  // Pairs of coefficients first (Estrin's scheme): fewer products wait for one another.
  const Lanes p0 = (z * kTerms[1]() + kTerms[0]()) + (z * kTerms[3]() + kTerms[2]()) * z2;
  const Lanes p4 = (z * kTerms[5]() + kTerms[4]()) + (z * kTerms[7]() + kTerms[6]()) * z2;
  const Lanes p8 = (z * kTerms[9]() + kTerms[8]()) + z2 * kTerms[10]();
  const Lanes to_diagonal = kEighth() - w * (p0 + (p4 + p8 * z4) * z4);
  return kHalf() - x_sign * (kQuarter() + sign_of(width - y) * to_diagonal);
}

}  // namespace tvg
