#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// Adaptive probability models (format-spec §6.2), shared by encoder and decoder. All arithmetic is in
// integers.
namespace tvg {

/// Bits of the probability scale: the frequencies of a model add up to 1 << kProbabilityBits.
inline constexpr int kProbabilityBits = 15;

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

/// An adaptive alphabet of up to 16 symbols: a cumulative distribution that moves towards each symbol seen,
/// in large steps at first and in smaller ones later. The coder takes one model or the mean of two.
class AdaptiveSymbol {
 public:
  static constexpr int kMaxSymbols = 16;

  /// Starts with `symbol_count` (2 to 16) equally likely symbols.
  explicit AdaptiveSymbol(int symbol_count = kMaxSymbols) {
    for (int i = 0; i < kMaxSymbols; ++i) {
      cumulative_[static_cast<std::size_t>(i)] =
          static_cast<std::int16_t>(kScale * std::min(i, symbol_count) / symbol_count);
    }
  }

  /// Starts with a given distribution: weights add up to at most 0xFFFF; what is missing goes to the last
  /// symbol. It learns on as if it had seen so many symbols.
  explicit AdaptiveSymbol(const std::array<std::uint16_t, kMaxSymbols>& weights, std::uint8_t seen = 0)
      : count_(seen) {
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < kMaxSymbols; ++i) {
      cumulative_[i] = static_cast<std::int16_t>(sum * kScale / 0xFFFF);
      sum += weights[i];
    }
  }

  void adapt(std::uint32_t symbol) {
    const int rate = kRates[count_];
    const std::int16_t* goals = kGoals.data() + (kMaxSymbols - 1 - symbol);
#if defined(__SSE2__)
    const __m128i shift = _mm_cvtsi32_si128(rate);
    for (std::size_t half = 0; half < 2; ++half) {
      auto* lanes = reinterpret_cast<__m128i*>(cumulative_.data() + 8 * half);
      const __m128i old = _mm_load_si128(lanes);
      const __m128i goal = _mm_loadu_si128(reinterpret_cast<const __m128i*>(goals + 8 * half));
      _mm_store_si128(lanes, _mm_add_epi16(old, _mm_sra_epi16(_mm_sub_epi16(goal, old), shift)));
    }
#else
    for (std::size_t i = 0; i < kMaxSymbols; ++i) {
      cumulative_[i] = static_cast<std::int16_t>(cumulative_[i] + ((goals[i] - cumulative_[i]) >> rate));
    }
#endif
    count_ = static_cast<std::uint8_t>(count_ + (count_ < kRates.size() - 1 ? 1 : 0));
  }

 private:
  friend class SymbolMixture;

  /// [symbols seen]: the n-th symbol moves the boundaries by 2^-rate of the way.
  static constexpr std::array<std::uint8_t, 33> kRates = [] {
    std::array<std::uint8_t, 33> rates{};
    for (std::size_t n = 0; n < rates.size(); ++n)
      rates[n] = n < 2 ? 2 : n < 6 ? 3 : n < 16 ? 4 : n < 32 ? 5 : 6;
    return rates;
  }();
  /// What all probabilities of a model add up to; the rest of 1 << 15 is shared out evenly by SymbolMixture.
  static constexpr std::int16_t kScale = (1 << kProbabilityBits) - 4 * kMaxSymbols;
  /// kGoals[15 - s + i] is where boundary i moves after symbol s: kScale where i > s, else 0.
  static constexpr std::array<std::int16_t, 2 * kMaxSymbols> kGoals = [] {
    std::array<std::int16_t, 2 * kMaxSymbols> goals{};
    for (std::size_t i = kMaxSymbols; i < goals.size(); ++i) goals[i] = kScale;
    return goals;
  }();

  /// [i]: probability of the symbols below i, out of kScale; never decreases with i.
  alignas(16) std::array<std::int16_t, kMaxSymbols> cumulative_;
  std::uint8_t count_ = 0;
};

/// The distribution a symbol is coded with: the mean of two models, scaled so that every symbol has a
/// frequency of at least 4 out of 1 << 15.
class SymbolMixture {
 public:
  struct Interval {
    std::uint32_t symbol, low, high;
  };

  SymbolMixture(const AdaptiveSymbol& a, const AdaptiveSymbol& b) {
    for (std::size_t half = 0; half < 2; ++half) {
#if defined(__SSE2__)
      const __m128i lanes_a =
          _mm_load_si128(reinterpret_cast<const __m128i*>(a.cumulative_.data() + 8 * half));
      const __m128i lanes_b =
          _mm_load_si128(reinterpret_cast<const __m128i*>(b.cumulative_.data() + 8 * half));
      const __m128i offsets = _mm_load_si128(reinterpret_cast<const __m128i*>(kOffsets.data() + 8 * half));
      _mm_store_si128(reinterpret_cast<__m128i*>(cumulative_.data() + 8 * half),
                      _mm_add_epi16(_mm_avg_epu16(lanes_a, lanes_b), offsets));
#else
      for (std::size_t i = 8 * half; i < 8 * half + 8; ++i) {
        cumulative_[i] =
            static_cast<std::uint16_t>((a.cumulative_[i] + b.cumulative_[i] + 1) / 2 + kOffsets[i]);
      }
#endif
    }
    cumulative_[AdaptiveSymbol::kMaxSymbols] = 1u << kProbabilityBits;
  }

  /// Sum of the frequencies of all symbols below `symbol` (0 to 16).
  std::uint32_t cumulative(std::uint32_t symbol) const {
    return cumulative_[symbol];
  }

  /// The interval of a symbol under the mixture of two models, without the rest of it.
  static Interval interval_of(const AdaptiveSymbol& a, const AdaptiveSymbol& b, std::uint32_t symbol) {
    return {symbol, boundary(a, b, symbol), boundary(a, b, symbol + 1)};
  }

  /// The symbol whose interval holds `target`, which is below 1 << 15.
  Interval find(std::uint32_t target) const {
#if defined(__SSE2__)
    const __m128i wanted = _mm_set1_epi16(static_cast<short>(target));
    const auto* lanes = reinterpret_cast<const __m128i*>(cumulative_.data());
    const __m128i above = _mm_packs_epi16(_mm_cmpgt_epi16(_mm_load_si128(lanes), wanted),
                                          _mm_cmpgt_epi16(_mm_load_si128(lanes + 1), wanted));
    const auto mask = static_cast<std::uint32_t>(_mm_movemask_epi8(above)) | 0x10000u;
    const auto symbol = static_cast<std::uint32_t>(std::countr_zero(mask)) - 1;
#else
    std::uint32_t symbol = 0;
    for (std::size_t i = 1; i < AdaptiveSymbol::kMaxSymbols; ++i) symbol += cumulative_[i] <= target ? 1 : 0;
#endif
    return {symbol, cumulative_[symbol], cumulative_[symbol + 1]};
  }

 private:
  static std::uint32_t boundary(const AdaptiveSymbol& a, const AdaptiveSymbol& b, std::uint32_t symbol) {
    if (symbol == AdaptiveSymbol::kMaxSymbols) return 1u << kProbabilityBits;
    const auto sum = static_cast<std::uint32_t>(a.cumulative_[symbol] + b.cumulative_[symbol] + 1);
    return (sum >> 1) + kOffsets[symbol];
  }

  /// 4 i: the smallest frequency of each symbol, summed.
  alignas(16) static constexpr std::array<std::uint16_t, AdaptiveSymbol::kMaxSymbols> kOffsets = {
      0, 4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 60};

  alignas(16) std::array<std::uint16_t, AdaptiveSymbol::kMaxSymbols + 1> cumulative_;
};

}  // namespace tvg
