#pragma once
#include "entropy/adaptive_models.hpp"
#include "entropy/code_bits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

// Models of residuals of up to 32 bits (format-spec §7.9.4): how many bits a residual has is coded against
// how many are expected; of the bits themselves, the sign and the one below the leading one have models.
namespace tvg {

/// What is known of a residual before it is coded. Sizes are 16 log2 of the size in steps.
struct LengthExpectation {
  std::int32_t size = 0;    ///< expected size of the residual
  std::int32_t beside = 0;  ///< sizes at the vertices it is predicted from
  std::int32_t before = 0;  ///< size at the vertex itself in the frame before, or a second opinion
  std::int32_t lost = 0;    ///< the prediction less its rounded value, in 1/64 of a step, -32 to 31
  std::size_t signs = 0;    ///< below LengthModels::kSigns: on which sides what is around was missed
  bool first = false;       ///< there is no frame before
};

class LengthModels {
 public:
  static constexpr std::size_t kSigns = 27;

  LengthModels() : by_size_(2 * kBases * kSizes), by_place_(2 * kBases * kPlaces) {}

  static constexpr std::size_t bytes() { return 2 * kBases * (kSizes + kPlaces) * sizeof(AdaptiveSymbol); }

  /// Codes one residual, which is meant modulo 2^32, and returns it; a decoder ignores the argument.
  template <class Coder>
  [[gnu::always_inline]] std::uint32_t code(Coder& coder, const LengthExpectation& known,
                                            std::uint32_t residual) {
    const std::int32_t base = std::clamp((known.beside + known.before + 16) >> 5, kLeastBase, kMostBase);
    const bool small = base <= 0;
    const std::size_t row = (known.first ? kBases : 0) + static_cast<std::size_t>(base - kLeastBase);
    const std::int32_t excess = known.size - 16 * base;
    const std::size_t by_size =
        kSizes * row +
        (small ? kSizes / 4 * part_of(known.lost) + bin(excess >> 3, kSizes / 4) : bin(excess >> 2, kSizes));
    const std::size_t by_place = kPlaces * row + bin((known.beside - known.before) >> 4, kPlaces);
    const bool is_negative = residual >> 31 != 0;
    const std::uint32_t wanted = is_negative ? 0 - residual : residual;
    const auto wanted_length = static_cast<std::int32_t>(std::bit_width(wanted));
    const std::uint32_t symbol =
        coder.code(by_size_[by_size], by_place_[by_place],
                   static_cast<std::uint32_t>(std::clamp(wanted_length - base + kMiddle, 0, kLast)));
    std::int32_t length = base - kMiddle + static_cast<std::int32_t>(symbol);
    if (symbol == 0 || symbol == kLast) [[unlikely]]
      length = static_cast<std::int32_t>(coder.code_raw(static_cast<std::uint32_t>(wanted_length), 6));
    if (length <= 0) return 0;
    length = std::min(length, kMostLength);
    AdaptiveBit& sign = small ? sign_by_loss_[loss_of(known.lost)] : sign_by_signs_[known.signs];
    const bool negative = coder.code(sign, is_negative);
    if (length == 1) return negative ? ~0u : 1;
    const int low_bits = length - 2;
    const std::uint32_t high = coder.code(second_[symbol], (wanted >> low_bits & 1) != 0) ? 3 : 2;
    const std::uint32_t low = code_bits(coder, wanted & ((1u << low_bits) - 1), low_bits);
    const std::uint32_t size = high << low_bits | low;
    return negative ? 0 - size : size;
  }

 private:
  static constexpr std::int32_t kMostLength = 32;
  static constexpr std::int32_t kLeastBase = -3, kMostBase = 32;
  static constexpr std::size_t kBases = 36, kSizes = 32, kPlaces = 16;
  /// Symbols 1 to 14 are lengths from 8 below to 5 above the base; 0 and 15 say that the length goes raw.
  static constexpr std::int32_t kMiddle = 9, kLast = 15;

  /// One of so many bins around zero.
  static std::size_t bin(std::int32_t offset, std::size_t count) {
    const auto half = static_cast<std::int32_t>(count / 2);
    return static_cast<std::size_t>(std::clamp(offset, -half, half - 1) + half);
  }
  static std::size_t part_of(std::int32_t lost) {
    return static_cast<std::size_t>(std::min((lost < 0 ? -lost : lost) >> 3, 3));
  }
  static std::size_t loss_of(std::int32_t lost) { return static_cast<std::size_t>((lost + 32) >> 3); }

  std::vector<AdaptiveSymbol> by_size_;   ///< [later, first][base][size]
  std::vector<AdaptiveSymbol> by_place_;  ///< [later, first][base][beside against before]
  std::array<AdaptiveBit, kSigns> sign_by_signs_;
  std::array<AdaptiveBit, 8> sign_by_loss_;  ///< where residuals are small
  std::array<AdaptiveBit, 16> second_;       ///< [symbol] the bit below the leading one
};

}  // namespace tvg
