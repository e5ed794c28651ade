#pragma once
#include "entropy/adaptive_models.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

// How a residual is coded (format-spec §7.3): a 16-symbol alphabet under the mean of two adaptive models.
// Both are chosen by the size residuals have had around here; one also by where the gate's residuals lean,
// the other by what the vertex did in the frame before.
namespace tvg {

/// What is known when a residual is coded; residuals and sizes are on the vertex's own lattice.
struct ResidualContext {
  std::uint32_t activity;  ///< weighted sum of the sizes of residuals already coded around
  std::int32_t lean;       ///< Prediction::lean
  std::int32_t gate;       ///< sum of the residuals at the gate's ends, this frame
  std::int32_t previous;   ///< the vertex's own residual in the frame before
};

class ResidualModels {
 public:
  ResidualModels();

  /// Codes one residual and returns it; a decoder ignores the argument. What a damaged stream yields is
  /// within +-2^27.
  template <class Coder>
  std::int32_t code(Coder& coder, const ResidualContext& context, std::int32_t residual) {
    const std::uint32_t level = level_of(context.activity);
    const std::uint32_t lean = clamped(context.lean, 2);
    Cell& cell = cells_[level];
    AdaptiveSymbol& by_gate = cell.by_gate[lean * 3 + clamped(context.gate, 1)];
    AdaptiveSymbol& by_previous = cell.by_previous[lean * 3 + clamped(context.previous, 1)];
    const int raw_bits = kRawBits[level];
    const std::int32_t high = residual >> raw_bits;
    const bool escaped = high < -kLargest || high > kLargest;
    const std::uint32_t wanted = escaped ? kEscape : static_cast<std::uint32_t>(high + kLargest);
    const std::uint32_t symbol = coder.code(by_gate, by_previous, wanted);
    if (symbol == kEscape) return code_escaped(coder, level, residual, high);
    if (raw_bits == 0) return static_cast<std::int32_t>(symbol) - kLargest;
    const std::uint32_t low =
        coder.code_raw(static_cast<std::uint32_t>(residual) & ((1u << raw_bits) - 1), raw_bits);
    return ((static_cast<std::int32_t>(symbol) - kLargest) << raw_bits) | static_cast<std::int32_t>(low);
  }

 private:
  static constexpr std::int32_t kLargest = 7;  ///< symbols 0 to 14 are -7 to 7, symbol 15 is the escape
  static constexpr std::uint32_t kEscape = 15;
  static constexpr std::size_t kLevels = 16;
  static constexpr std::array<std::uint8_t, kLevels> kRawBits = {0, 0, 0, 0, 0, 0, 0, 0,
                                                                 0, 0, 0, 1, 1, 2, 2, 3};
  /// Level l begins where the activity reaches kThresholds[l - 1] (about 4 (2^(l / 2.5) - 1)).
  static constexpr std::array<std::uint16_t, kLevels - 1> kThresholds = {2,  3,  6,  9,   12,  18,  24, 33,
                                                                         45, 60, 81, 108, 144, 190, 252};
  struct Cell {
    std::array<AdaptiveSymbol, 15> by_gate;      ///< [lean + 2][gate + 1]
    std::array<AdaptiveSymbol, 15> by_previous;  ///< [lean + 2][previous + 1]
    std::array<AdaptiveBit, 32> escape_length;
  };

  static std::uint32_t clamped(std::int32_t value, std::int32_t largest) {
    return static_cast<std::uint32_t>(std::clamp(value, -largest, largest) + largest);
  }

  static std::uint32_t level_of(std::uint32_t activity) {
    return kLevelOf[std::min<std::uint32_t>(activity, kLevelOf.size() - 1)];
  }

  /// Sizes that the alphabet does not reach: Elias-gamma, its length adaptive, then sign and the raw bits.
  template <class Coder>
  std::int32_t code_escaped(Coder& coder, std::uint32_t level, std::int32_t residual, std::int32_t high) {
    const int raw_bits = kRawBits[level];
    const bool negative = coder.code_raw(high < 0 ? 1 : 0, 1) != 0;
    const auto excess =
        static_cast<std::uint32_t>(high < 0 ? -(high + kLargest) : high - kLargest);  // at least 1
    int length = 31 - std::countl_zero(excess | 1);
    int coded = 0;
    while (coded < 27 &&
           coder.code(cells_[level].escape_length[static_cast<std::size_t>(coded)], coded < length))
      ++coded;
    length = coded;
    std::uint32_t magnitude = 1;
    for (int left = length; left > 0;) {
      const int now = std::min(left, 15);
      left -= now;
      magnitude = (magnitude << now) | coder.code_raw((excess >> left) & ((1u << now) - 1), now);
    }
    const std::int64_t size = std::int64_t{magnitude} + kLargest;
    const std::uint32_t low =
        raw_bits == 0
            ? 0
            : coder.code_raw(static_cast<std::uint32_t>(residual) & ((1u << raw_bits) - 1), raw_bits);
    const std::int64_t value = (negative ? -size : size) * (std::int64_t{1} << raw_bits) + low;
    constexpr std::int64_t kBound = std::int64_t{1} << 27;
    return static_cast<std::int32_t>(std::clamp(value, -kBound, kBound));
  }

  static const std::array<std::uint8_t, 256> kLevelOf;

  std::vector<Cell> cells_;  ///< [level]
};

}  // namespace tvg
