#pragma once
#include "base/bits.hpp"

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

  class Goals;

  /// Starts with `symbol_count` (2 to 16) equally likely symbols.
  explicit AdaptiveSymbol(int symbol_count = kMaxSymbols) {
    for (int i = 0; i < kMaxSymbols; ++i) {
      lanes_[static_cast<std::size_t>(i)] =
          static_cast<std::int16_t>(kScale * std::min(i, symbol_count) / symbol_count);
    }
  }

  /// Starts with a given distribution: weights add up to at most 0xFFFF; what is missing goes to the last
  /// symbol. It learns on as if it had seen so many symbols.
  explicit AdaptiveSymbol(const std::array<std::uint16_t, kMaxSymbols>& weights, int seen = 0) {
    std::int32_t sum = 0;
    for (std::size_t i = 0; i < kMaxSymbols; ++i) {
      lanes_[i] = static_cast<std::int16_t>(sum * kScale / 0xFFFF);
      sum += weights[i];
    }
    for (int i = 0; i < seen; ++i) lanes_[0] = moved(lanes_[0], kScale, rate());
  }

  /// Learns a symbol.
  void adapt(std::uint32_t symbol);
  void adapt(const Goals& goals);

 private:
  friend class SymbolMixture;

  static constexpr std::int16_t moved(std::int16_t from, std::int16_t goal, std::uint32_t rate) {
    return static_cast<std::int16_t>(from + ((goal - from) >> rate));
  }

  /// Symbols move the lanes by 2^-rate of the way.
  std::uint32_t rate() const { return kRates[static_cast<std::uint16_t>(lanes_[0]) >> 8]; }

  /// [lane 0 >> 8]: 2 for the first 2 symbols, 3 for the next 4, 4 for 10, 5 for 16, then 6.
  static constexpr std::array<std::uint32_t, 128> kRates = [] {
    std::array<std::uint32_t, 128> rates{};
    for (std::size_t n = 0; n < rates.size(); ++n)
      rates[n] = n < 44 ? 2 : n < 82 ? 3 : n < 105 ? 4 : n < 114 ? 5 : 6;
    return rates;
  }();
  /// What all probabilities of a model add up to; the rest of 1 << 15 is shared out evenly by SymbolMixture.
  static constexpr std::int16_t kScale = (1 << kProbabilityBits) - 4 * kMaxSymbols;

  /// [i > 0]: probability of the symbols below i, out of kScale; never decreases with i. [0] moves from 0
  /// towards kScale with every symbol: it tells how many there have been.
  alignas(32) std::array<std::int16_t, kMaxSymbols> lanes_;
};

/// Where a symbol that is seen moves the lanes of its models.
class AdaptiveSymbol::Goals {
 public:
  explicit Goals(std::uint32_t symbol) {
#if defined(__SSE2__)
    low_ = _mm_load_si128(reinterpret_cast<const __m128i*>(kGoals[symbol].data()));
    high_ = _mm_load_si128(reinterpret_cast<const __m128i*>(kGoals[symbol].data() + 8));
#else
    goals_ = kGoals[symbol].data();
#endif
  }

 private:
  friend class AdaptiveSymbol;
  friend class SymbolMixture;

  /// [symbol][lane]: kScale for the boundaries beyond the symbol and for lane 0, else 0.
  alignas(16) static constexpr std::array<std::array<std::int16_t, kMaxSymbols>, kMaxSymbols> kGoals = [] {
    std::array<std::array<std::int16_t, kMaxSymbols>, kMaxSymbols> goals{};
    for (std::size_t symbol = 0; symbol < goals.size(); ++symbol) {
      for (std::size_t i = 0; i < kMaxSymbols; ++i) goals[symbol][i] = i == 0 || i > symbol ? kScale : 0;
    }
    return goals;
  }();

#if defined(__SSE2__)
  Goals(__m128i low, __m128i high) : low_(low), high_(high) {}

  __m128i low_, high_;
#else
  const std::int16_t* goals_;
#endif
};

inline void AdaptiveSymbol::adapt(const Goals& goals) {
#if defined(__SSE2__)
  const __m128i rate_lane = _mm_cvtsi32_si128(static_cast<int>(rate()));
  auto* lanes = reinterpret_cast<__m128i*>(lanes_.data());
  const __m128i low = _mm_load_si128(lanes), high = _mm_load_si128(lanes + 1);
  _mm_store_si128(lanes, _mm_add_epi16(low, _mm_sra_epi16(_mm_sub_epi16(goals.low_, low), rate_lane)));
  _mm_store_si128(lanes + 1, _mm_add_epi16(high, _mm_sra_epi16(_mm_sub_epi16(goals.high_, high), rate_lane)));
#else
  const std::uint32_t common_rate = rate();
  for (std::size_t i = 0; i < kMaxSymbols; ++i) lanes_[i] = moved(lanes_[i], goals.goals_[i], common_rate);
#endif
}

inline void AdaptiveSymbol::adapt(std::uint32_t symbol) {
  adapt(Goals(symbol));
}

/// The distribution a symbol is coded with: the mean of two models, scaled so that every symbol has a
/// frequency of at least 8 out of 1 << 16.
class SymbolMixture {
 public:
  /// Where a symbol lies within a range.
  struct Interval {
    std::uint32_t low, high;
  };
  struct Found {
    std::uint32_t symbol;
    Interval interval;
    AdaptiveSymbol::Goals goals;
  };

  SymbolMixture(const AdaptiveSymbol& a, const AdaptiveSymbol& b) {
#if defined(__SSE2__)
    const auto* lanes_a = reinterpret_cast<const __m128i*>(a.lanes_.data());
    const auto* lanes_b = reinterpret_cast<const __m128i*>(b.lanes_.data());
    const auto* offsets = reinterpret_cast<const __m128i*>(kOffsets.data());
    const __m128i sums = _mm_add_epi16(_mm_load_si128(lanes_a), _mm_load_si128(lanes_b));
    const __m128i first_is_zero = _mm_set_epi16(-1, -1, -1, -1, -1, -1, -1, 0);
    low_ = _mm_add_epi16(_mm_and_si128(sums, first_is_zero), _mm_load_si128(offsets));
    high_ = _mm_add_epi16(_mm_add_epi16(_mm_load_si128(lanes_a + 1), _mm_load_si128(lanes_b + 1)),
                          _mm_load_si128(offsets + 1));
#else
    for (std::uint32_t i = 0; i < AdaptiveSymbol::kMaxSymbols; ++i) cumulative_[i] = cumulative(a, b, i);
#endif
  }

  /// Sum of the frequencies of all symbols below `symbol` (0 to 16) in the mixture of two models.
  static std::uint32_t cumulative(const AdaptiveSymbol& a, const AdaptiveSymbol& b, std::uint32_t symbol) {
    if (symbol == 0) return 0;
    if (symbol == AdaptiveSymbol::kMaxSymbols) return 1u << 16;
    return static_cast<std::uint32_t>(a.lanes_[symbol] + b.lanes_[symbol]) + kOffsets[symbol];
  }

  /// The interval of a symbol within a range, under the mixture of two models, without the rest of it.
  static Interval interval_of(const AdaptiveSymbol& a, const AdaptiveSymbol& b, std::uint32_t symbol,
                              std::uint32_t range) {
    return {cumulative(a, b, symbol) * range >> 16, cumulative(a, b, symbol + 1) * range >> 16};
  }

  /// The symbol whose interval holds `code`, which is below `range`, which is below 1 << 16.
  [[gnu::always_inline]] Found find(std::uint32_t range, std::uint32_t code) const {
    alignas(16) std::array<std::uint16_t, AdaptiveSymbol::kMaxSymbols + 1> boundaries;
#if defined(__SSE2__)
    const __m128i ranges = _mm_set1_epi16(static_cast<short>(range));
    const __m128i codes = _mm_set1_epi16(static_cast<short>(code));
    const __m128i low = _mm_mulhi_epu16(low_, ranges);
    const __m128i high = _mm_mulhi_epu16(high_, ranges);
    auto* lanes = reinterpret_cast<__m128i*>(boundaries.data());
    _mm_store_si128(lanes, low);
    _mm_store_si128(lanes + 1, high);
    const __m128i zero = _mm_setzero_si128();
    const __m128i low_reached = _mm_cmpeq_epi16(_mm_subs_epu16(low, codes), zero);
    const __m128i high_reached = _mm_cmpeq_epi16(_mm_subs_epu16(high, codes), zero);
    const auto reached =
        static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(low_reached, high_reached)));
    const std::uint32_t symbol = highest_bit(reached);
    const __m128i scale = _mm_set1_epi16(AdaptiveSymbol::kScale);
    const __m128i seen = _mm_cvtsi32_si128(AdaptiveSymbol::kScale);
    boundaries[AdaptiveSymbol::kMaxSymbols] = static_cast<std::uint16_t>(range);
    return {symbol,
            {boundaries[symbol], boundaries[symbol + 1]},
            AdaptiveSymbol::Goals(_mm_or_si128(_mm_andnot_si128(low_reached, scale), seen),
                                  _mm_andnot_si128(high_reached, scale))};
#else
    std::uint32_t symbol = 0;
    for (std::size_t i = 0; i < AdaptiveSymbol::kMaxSymbols; ++i)
      boundaries[i] = static_cast<std::uint16_t>(cumulative_[i] * range >> 16);
    for (std::size_t i = 1; i < AdaptiveSymbol::kMaxSymbols; ++i) symbol += boundaries[i] <= code ? 1 : 0;
    boundaries[AdaptiveSymbol::kMaxSymbols] = static_cast<std::uint16_t>(range);
    return {symbol, {boundaries[symbol], boundaries[symbol + 1]}, AdaptiveSymbol::Goals(symbol)};
#endif
  }

 private:
  /// 8 i: the smallest frequency of each symbol, summed.
  alignas(16) static constexpr std::array<std::uint16_t, AdaptiveSymbol::kMaxSymbols> kOffsets = {
      0, 8, 16, 24, 32, 40, 48, 56, 64, 72, 80, 88, 96, 104, 112, 120};

#if defined(__SSE2__)
  __m128i low_, high_;  ///< boundaries out of 1 << 16
#else
  std::array<std::uint32_t, AdaptiveSymbol::kMaxSymbols> cumulative_;
#endif
};

}  // namespace tvg
