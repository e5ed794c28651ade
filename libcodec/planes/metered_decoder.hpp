#pragma once
#include "entropy/two_ended_coder.hpp"

#include <array>
#include <cstddef>

namespace tvg {

/// A TwoEndedDecoder that keeps account of the bits each plane of a group takes.
template <std::size_t kPlanes>
class MeteredDecoder : public TwoEndedDecoder {
 public:
  using TwoEndedDecoder::TwoEndedDecoder;

  /// Asked for once for each residual, before it.
  RangeDecoder& lane(std::size_t plane) {
    settle();
    plane_ = plane;
    return TwoEndedDecoder::lane(plane);
  }

  /// [plane]: bits since the start.
  std::array<double, kPlanes> bits() {
    settle();
    return bits_;
  }

 private:
  void settle() {
    const double now = used_bits();
    bits_[plane_] += now - settled_;
    settled_ = now;
  }

  std::array<double, kPlanes> bits_{};
  std::size_t plane_ = 0;  ///< of the residual begun last
  double settled_ = 0;
};

}  // namespace tvg
