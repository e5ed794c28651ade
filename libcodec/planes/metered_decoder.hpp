#pragma once
#include "entropy/range_coder.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tvg {

/// A RangeDecoder that keeps account of the bits each plane of a group takes: residuals come plane after
/// plane, and each begins with the one symbol that is coded with two models.
template <std::size_t kPlanes>
class MeteredDecoder : public RangeDecoder {
 public:
  using RangeDecoder::code;
  using RangeDecoder::RangeDecoder;

  std::uint32_t code(AdaptiveSymbol& a, AdaptiveSymbol& b, std::uint32_t /*ignored*/ = 0) {
    settle();
    plane_ = plane_ + 1 == kPlanes ? 0 : plane_ + 1;
    return RangeDecoder::code(a, b);
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
  std::size_t plane_ = kPlanes - 1;  ///< of the residual begun last
  double settled_ = 0;
};

}  // namespace tvg
