#pragma once
#include "entropy/adaptive_models.hpp"
#include "entropy/code_bits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <vector>

// How a residual is coded (format-spec §7.3): a 16-symbol alphabet under the mean of two adaptive models.
// Both are chosen by the size residuals have had around here; one also by where the gate's residuals lean,
// the other by what the vertex did in the frame before.
namespace tvg {

/// Where a residual's models stand: the contexts of the planes that are coded choose it.
struct ModelChoice {
  std::size_t set;         ///< below the number of sets
  std::uint32_t activity;  ///< weighted sum of the sizes of residuals already coded around
  std::uint32_t first;     ///< 0 to 14
  std::uint32_t second;    ///< 0 to 14
};

class ResidualModels {
 public:
  /// `set_count` independent sets of models, all in their initial state.
  explicit ResidualModels(std::size_t set_count) : cells_(set_count * kLevels) {}

  /// What so many sets take of memory.
  static constexpr std::size_t bytes(std::size_t set_count) { return set_count * kLevels * sizeof(Cell); }

  /// Codes one residual and returns it; a decoder ignores the argument. What a damaged stream yields is
  /// within +-2^27.
  template <class Coder>
  [[gnu::always_inline]] std::int32_t code(Coder& coder, const ModelChoice& choice, std::int32_t residual) {
    const std::size_t level = kLevelOf[std::min<std::uint32_t>(choice.activity, kLevelOf.size() - 1)];
    Cell& cell = cells_[kLevels * choice.set + level];
    AdaptiveSymbol& first = cell.first[choice.first];
    AdaptiveSymbol& second = cell.second[choice.second];
    if (level >= kFirstLevelWithRawBits) [[unlikely]]
      return code_large(coder, cell, first, second, kRawBits[level], residual);
    const bool fits = residual >= -kLargest && residual <= kLargest;
    const std::uint32_t symbol =
        coder.code(first, second, fits ? static_cast<std::uint32_t>(residual + kLargest) : kEscape);
    if (symbol == kEscape) [[unlikely]]
      return code_escaped(coder, cell, residual);
    return static_cast<std::int32_t>(symbol) - kLargest;
  }

 private:
  static constexpr std::int32_t kLargest = 7;  ///< symbols 0 to 14 are -7 to 7, symbol 15 is the escape
  static constexpr std::uint32_t kEscape = 15;
  static constexpr std::size_t kLevels = 16;
  static constexpr std::size_t kFirstLevelWithRawBits = 11;
  static constexpr std::array<std::uint8_t, kLevels> kRawBits = {0, 0, 0, 0, 0, 0, 0, 0,
                                                                 0, 0, 0, 1, 1, 2, 2, 3};
  /// Level l begins where the activity reaches kThresholds[l - 1] (about 4 (2^(l / 2.5) - 1)).
  static constexpr std::array<std::uint16_t, kLevels - 1> kThresholds = {2,  3,  6,  9,   12,  18,  24, 33,
                                                                         45, 60, 81, 108, 144, 190, 252};
  static constexpr std::array<std::uint8_t, 256> kLevelOf = [] {
    std::array<std::uint8_t, 256> levels{};
    for (std::size_t activity = 0; activity < levels.size(); ++activity) {
      while (levels[activity] < kThresholds.size() && activity >= kThresholds[levels[activity]])
        ++levels[activity];
    }
    return levels;
  }();

  struct Cell {
    std::array<AdaptiveSymbol, 15> first;
    std::array<AdaptiveSymbol, 15> second;
    std::array<AdaptiveBit, 27> escape_length;
  };

  /// Around large residuals the low bits are all alike: they go without a model.
  template <class Coder>
  [[gnu::noinline]] static std::int32_t code_large(Coder& coder, Cell& cell, AdaptiveSymbol& first,
                                                   AdaptiveSymbol& second, int raw_bits,
                                                   std::int32_t residual) {
    const std::int32_t wanted = residual >> raw_bits;
    const bool fits = wanted >= -kLargest && wanted <= kLargest;
    const std::uint32_t symbol =
        coder.code(first, second, fits ? static_cast<std::uint32_t>(wanted + kLargest) : kEscape);
    const std::int32_t high =
        symbol == kEscape ? code_escaped(coder, cell, wanted) : static_cast<std::int32_t>(symbol) - kLargest;
    const std::uint32_t low =
        coder.code_raw(static_cast<std::uint32_t>(residual) & ((1u << raw_bits) - 1), raw_bits);
    const std::int64_t value = high * (std::int64_t{1} << raw_bits) + low;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, -kBound, kBound));
  }

  /// Sizes that the alphabet does not reach: a sign, then Elias' gamma code of what is beyond, its length
  /// adaptive.
  template <class Coder>
  [[gnu::noinline]] static std::int32_t code_escaped(Coder& coder, Cell& cell, std::int32_t residual) {
    const bool negative = coder.code_raw(residual < 0 ? 1 : 0, 1) != 0;
    const auto beyond = static_cast<std::uint32_t>(std::max(std::abs(residual) - kLargest, 1));
    const int wanted_length = std::bit_width(beyond) - 1;
    int length = 0;
    while (length < static_cast<int>(cell.escape_length.size()) &&
           coder.code(cell.escape_length[static_cast<std::size_t>(length)], length < wanted_length)) {
      ++length;
    }
    const std::uint32_t value = (1u << length) | code_bits(coder, beyond, length);
    const auto size = static_cast<std::int32_t>(std::min<std::uint32_t>(value + kLargest, kBound));
    return negative ? -size : size;
  }

  static constexpr std::int32_t kBound = 1 << 27;

  std::vector<Cell> cells_;  ///< [set][level]
};

}  // namespace tvg
