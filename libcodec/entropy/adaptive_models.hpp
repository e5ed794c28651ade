#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

// Adaptive probability models (format-spec §6.2), shared by encoder and decoder. All arithmetic is in integers.
namespace tvg {

/// One binary decision. Two estimates of the probability of zero, one fast and one slow, are averaged.
class AdaptiveBit {
 public:
  /// Frequency of zero out of 1 << 15, in [32, 32736].
  std::uint32_t zero_frequency() const {
    const std::uint32_t mean = (std::uint32_t{fast_} + slow_) >> 2;
    return 32 + mean - (mean >> 9);
  }

  void adapt(bool bit) {
    const int slow_rate = std::min(4 + count_ / 4, 7);
    if (bit) {
      fast_ = static_cast<std::uint16_t>(fast_ - (fast_ >> 4));
      slow_ = static_cast<std::uint16_t>(slow_ - (slow_ >> slow_rate));
    } else {
      fast_ = static_cast<std::uint16_t>(fast_ + ((0xFFFF - fast_) >> 4));
      slow_ = static_cast<std::uint16_t>(slow_ + ((0xFFFF - slow_) >> slow_rate));
    }
    if (count_ < 12) ++count_;
  }

 private:
  std::uint16_t fast_ = 0x8000;
  std::uint16_t slow_ = 0x8000;
  std::uint8_t count_ = 0;
};

/// An adaptive alphabet of up to 16 symbols. Two cumulative distributions, one fast and one slow, are averaged.
class AdaptiveSymbol {
 public:
  static constexpr int kMaxSymbols = 16;

  struct Interval {
    std::uint32_t symbol, low, high;
  };

  /// Starts with `symbol_count` (2 to 16) equally likely symbols.
  explicit AdaptiveSymbol(int symbol_count = kMaxSymbols) {
    for (int i = 0; i < kMaxSymbols; ++i) {
      const int boundary = std::min(i, symbol_count);
      fast_[static_cast<std::size_t>(i)] = slow_[static_cast<std::size_t>(i)] =
          static_cast<std::uint16_t>(0xFFFF * boundary / symbol_count);
    }
  }

  /// Sum of the frequencies of all symbols below `symbol` (0 to 16), out of 1 << 15. Every symbol has a frequency of
  /// at least 4.
  std::uint32_t cumulative(std::uint32_t symbol) const {
    if (symbol == kMaxSymbols) return 1u << 15;
    const std::uint32_t mean = (std::uint32_t{fast_[symbol]} + slow_[symbol]) >> 2;
    return mean - (mean >> 9) + 4 * symbol;
  }

  /// The symbol whose interval holds `target`, which is below 1 << 15.
  Interval find(std::uint32_t target) const {
    std::uint32_t symbol = 0;
    for (std::uint32_t i = 1; i < kMaxSymbols; ++i) symbol += cumulative(i) <= target ? 1 : 0;
    return {symbol, cumulative(symbol), cumulative(symbol + 1)};
  }

  void adapt(std::uint32_t symbol) {
    const int slow_rate = std::min(4 + count_ / 8, 7);
    for (std::uint32_t i = 1; i < kMaxSymbols; ++i) {
      const std::uint16_t goal = i > symbol ? 0xFFFF : 0;
      fast_[i] = step(fast_[i], goal, 4);
      slow_[i] = step(slow_[i], goal, slow_rate);
    }
    if (count_ < 24) ++count_;
  }

 private:
  /// Moves towards 0 or 0xFFFF by 2^-rate of the way, rounding the move down.
  static std::uint16_t step(std::uint16_t value, std::uint16_t goal, int rate) {
    const std::uint16_t distance = value ^ goal;
    return static_cast<std::uint16_t>(goal ^ static_cast<std::uint16_t>(distance - (distance >> rate)));
  }

  alignas(16) std::array<std::uint16_t, kMaxSymbols> fast_;
  alignas(16) std::array<std::uint16_t, kMaxSymbols> slow_;
  int count_ = 0;
};

}  // namespace tvg
