#pragma once
#include "entropy/adaptive_models.hpp"
#include "planes/residual_alphabet.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

// Models of a residual whose size is expected (format-spec §7.7.4): one is chosen by the expected size and by
// what rounding took from the prediction, the other by the sizes next to the vertex in space and in time.
// They begin with what residuals of such a size look like, for in a short stream there is no time to learn.
namespace tvg {

/// What is known of a residual before it is coded. Sizes are in 1/256 of a cell.
struct Expectation {
  std::uint32_t size = 0;    ///< expected size of the residual
  std::uint32_t beside = 0;  ///< sizes at the vertices it is predicted from
  std::uint32_t before = 0;  ///< size at the vertex itself in the planes before, or a second opinion
  std::int32_t lost = 0;     ///< the prediction less its rounded value, in 1/64 of a cell, -32 to 32
  bool first = false;        ///< there are no planes before
};

class MagnitudeModels {
  /// floor(3 log2(x)), nearly.
  static constexpr std::size_t thirds(std::uint32_t x) {
    const auto whole = static_cast<std::size_t>(std::bit_width(x)) - 1;
    const std::uint32_t part = static_cast<std::uint32_t>((std::uint64_t{x} << 6) >> whole) & 63;
    return 3 * whole + (part >= 37 ? 2u : part >= 17 ? 1u : 0u);
  }

 public:
  static constexpr std::size_t kLevels = 26;  ///< a third of an octave each, the first up to 1/40 of a cell
  /// The level of a size in 1/256 of a cell.
  static constexpr std::size_t level_of(std::uint32_t size) {
    constexpr std::size_t kBefore = thirds(5);
    const std::size_t level = thirds(size | 1);
    return std::min(level < kBefore ? 0 : level - kBefore, kLevels - 1);
  }

  MagnitudeModels() : by_size_(kSizeModels), by_place_(2 * kPlaceModels) {
    for (std::size_t i = 0; i < kSizeModels; ++i)
      by_size_[i] = fresh(size_of(i / kParts % kLevels, i >= kFirstOfLarge));
    for (std::size_t i = 0; i < by_place_.size(); ++i) {
      const std::size_t beside = i % kPlaceModels / kPlaces, before = i % kPlaces;
      by_place_[i] = fresh((kPlaceSizes[beside] + kPlaceSizes[before]) / 2);
    }
  }

  static constexpr std::size_t bytes() {
    return (kSizeModels + 2 * kPlaceModels) * sizeof(AdaptiveSymbol) +
           sizeof(residual_alphabet::EscapeLength);
  }

  /// Codes one residual and returns it; a decoder ignores the argument.
  template <class Coder>
  [[gnu::always_inline]] std::int32_t code(Coder& coder, const Expectation& known, std::int32_t residual) {
    const Choice choice = choose(known);
    // Where rounding took something, the residual tends to give it back: the sign is told by that.
    const bool turned = known.lost < 0;
    const std::int32_t coded =
        residual_alphabet::code(coder, by_size_[choice.by_size], by_place_[choice.by_place], escape_length_,
                                choice.raw_bits, turned ? -residual : residual);
    return turned ? -coded : coded;
  }

  /// How likely a residual is by now: bits that are raw or escaped, and a share of 2^16 for the rest.
  struct Likelihood {
    int raw_bits = 0;
    std::uint32_t share = 0;
  };
  Likelihood likelihood(const Expectation& known, std::int32_t residual) const {
    const Choice choice = choose(known);
    const std::int32_t high = (known.lost < 0 ? -residual : residual) >> choice.raw_bits;
    const std::uint32_t symbol = residual_alphabet::symbol_of(high);
    const AdaptiveSymbol &a = by_size_[choice.by_size], &b = by_place_[choice.by_place];
    const std::uint32_t share =
        SymbolMixture::cumulative(a, b, symbol + 1) - SymbolMixture::cumulative(a, b, symbol);
    const int escaped = symbol == residual_alphabet::kEscape ? residual_alphabet::escaped_bits(high) : 0;
    return {choice.raw_bits + escaped, share};
  }

 private:
  struct Choice {
    std::size_t by_size, by_place;
    int raw_bits;
  };

  [[gnu::always_inline]] static Choice choose(const Expectation& known) {
    std::uint32_t size = known.size;
    int raw_bits = 0;
    for (; size > kLargestModelled && raw_bits < 15; size /= 2) ++raw_bits;
    const auto lost = static_cast<std::uint32_t>(known.lost < 0 ? -known.lost : known.lost);
    const std::size_t part = lost > 21 ? 2 : lost > 9 ? 1 : 0;
    return {(raw_bits > 0 ? kFirstOfLarge : 0) + kParts * level_of(size) + part,
            (known.first ? kPlaceModels : 0) + kPlaces * place_of(known.beside) + place_of(known.before),
            raw_bits};
  }

  static constexpr std::uint32_t kLargestModelled = 6 * 256;
  static constexpr std::size_t kParts = 3;
  static constexpr std::size_t kFirstOfLarge = kLevels * kParts;
  static constexpr std::size_t kSizeModels = 2 * kLevels * kParts;
  static constexpr std::size_t kPlaces = 10;  ///< half an octave each
  static constexpr std::size_t kPlaceModels = kPlaces * kPlaces;

  /// The size in the middle of a level.
  static constexpr std::uint32_t size_of(std::size_t level, bool large) {
    if (large) return 4 * 256;
    std::uint32_t size = 5;
    while (level_of(size) < level) ++size;
    return size + size / 8;
  }
  /// Sizes from which on the places are higher: 1/5 of a cell, then half an octave each.
  static constexpr std::array<std::uint32_t, kPlaces> kPlaceSizes = {26,  51,  72,  102, 145,
                                                                     205, 290, 410, 579, 819};
  static constexpr std::size_t place_of(std::uint32_t size) {
    std::size_t place = 0;
    while (place + 1 < kPlaces && size >= kPlaceSizes[place + 1]) ++place;
    return place;
  }

  /// A model that expects residuals of this mean size: they fall off by the same factor on both sides.
  static AdaptiveSymbol fresh(std::uint32_t size) {
    constexpr std::uint32_t kOne = 1u << 16;
    constexpr std::uint8_t kSeen = 6;
    const std::uint32_t factor = kOne / (256 + size) * size + 256;  // size / (1 + size)
    std::array<std::uint64_t, AdaptiveSymbol::kMaxSymbols> falling{};
    std::uint64_t value = kOne;
    for (std::int32_t r = 0; r <= residual_alphabet::kLargest; ++r, value = value * factor >> 16) {
      falling[residual_alphabet::symbol_of(r)] = falling[residual_alphabet::symbol_of(-r)] = value + 16;
    }
    falling[residual_alphabet::kEscape] = value + 16;
    return residual_alphabet::model_of(falling, kSeen);
  }

  std::vector<AdaptiveSymbol> by_size_;   ///< [small, large][level][part]
  std::vector<AdaptiveSymbol> by_place_;  ///< [later, first][beside][before]
  residual_alphabet::EscapeLength escape_length_;
};

}  // namespace tvg
