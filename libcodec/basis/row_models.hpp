#pragma once
#include "entropy/adaptive_models.hpp"
#include "planes/residual_alphabet.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tvg {

/// Codes what predictions of row values miss (format-spec §7.8.4): with the mean of a distribution of known
/// shape, which takes the expected size and the fraction of the prediction as they are, and one that is
/// learnt for sizes about as large.
class RowModels {
 public:
  static constexpr std::uint32_t kLeastSize = 5;
  static constexpr std::uint32_t kMostSize = 1u << 24;

  RowModels() {
    for (std::size_t level = 0; level < kLevels; ++level)
      learnt_[level] = expected(std::min(12u << level, 768u), 0, 0);
  }

  /// Codes a residual and returns it; a decoder ignores the argument. `size` is the expected size in 1/256,
  /// kLeastSize to kMostSize, `lost` the prediction less its rounded value in 1/64, -32 to 32.
  template <class Coder>
  std::int32_t code(Coder& coder, std::uint32_t size, std::int32_t lost, std::int32_t residual) {
    const int width = std::bit_width(size);
    const int raw_bits = std::max(width - kModelledBits, 0);
    const std::size_t level = raw_bits > 0 ? kLevels - 1 : static_cast<std::size_t>(std::max(width - 4, 0));
    const bool turned = lost < 0;
    AdaptiveSymbol shaped = expected(size >> raw_bits, turned ? -lost : lost, raw_bits);
    const std::int32_t coded = residual_alphabet::code(coder, learnt_[level], shaped, escape_length_,
                                                       raw_bits, turned ? -residual : residual);
    return turned ? -coded : coded;
  }

 private:
  static constexpr int kModelledBits = 10;   ///< of a size; for each above that a low bit goes raw
  static constexpr std::size_t kLevels = 8;  ///< an octave each, the last for all that are larger
  static constexpr std::int32_t kReach = 1024;

  /// [64 u + 1024]: 65535 times the share of values below u + 1/128 in Student's distribution with four
  /// degrees of freedom, whose mean size is 1.
  static const std::array<std::uint16_t, 2 * kReach>& shares() {
    static const std::array<std::uint16_t, 2 * kReach> table = [] {
      std::array<std::uint16_t, 2 * kReach> made{};
      for (std::size_t i = 0; i < made.size(); ++i) {
        const double u = (static_cast<double>(i) - kReach + 0.5) / 64.0;
        const double s = u / std::sqrt(4.0 + u * u);
        made[i] = static_cast<std::uint16_t>(std::floor(65535.0 * (0.5 + 0.25 * s * (3.0 - s * s)) + 0.5));
      }
      return made;
    }();
    return table;
  }

  /// How likely each symbol is where residuals have this mean size in 1/256 of 2^raw_bits.
  AdaptiveSymbol expected(std::uint32_t size, std::int32_t lost, int raw_bits) const {
    // 2^24 / 0.9: large residuals are fewer than their mean size makes one think.
    const auto scale = static_cast<std::int32_t>(18641351u / size);
    const std::int32_t start = (32 + lost) >> raw_bits;
    std::array<std::uint16_t, AdaptiveSymbol::kMaxSymbols> below{};
    for (std::int32_t i = 0; i < AdaptiveSymbol::kMaxSymbols; ++i) {
      const std::int32_t u = ((i - residual_alphabet::kLargest) * 64 - start) * scale >> 16;
      const std::int32_t at = std::clamp(u, -kReach, kReach - 1) + kReach;
      below[static_cast<std::size_t>(i)] = (*shares_)[static_cast<std::size_t>(at)];
    }
    std::array<std::uint16_t, AdaptiveSymbol::kMaxSymbols> weights{};
    for (std::size_t i = 0; i + 1 < weights.size(); ++i)
      weights[i] = static_cast<std::uint16_t>(below[i + 1] - below[i]);
    return AdaptiveSymbol(weights, kSeen);
  }

  static constexpr std::uint8_t kSeen = 6;

  const std::array<std::uint16_t, 2 * kReach>* shares_ = &shares();
  std::array<AdaptiveSymbol, kLevels> learnt_;
  residual_alphabet::EscapeLength escape_length_;
};

}  // namespace tvg
