#pragma once
#include "attributes/attribute_grid.hpp"
#include "entropy/adaptive_models.hpp"
#include "entropy/code_bits.hpp"
#include "planes/shape_models.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

// How the residuals of attributes are coded (format-spec §5.7.6).
namespace tvg {

/// What is known about a residual before it is coded.
struct ResidualOutlook {
  std::int64_t beside = 0;  ///< sum of the sizes of what lies beside
  int near = 0;             ///< of so many
  int kind = 0;             ///< 0 to 3: how much there is to predict from
  bool alone = false;       ///< there is less to predict from than usual
  double spread = 0;        ///< how far the opinions are from each other, in steps
  std::int32_t lost = 0;    ///< -8 to 8: what rounding took from the prediction, in 1/16
};

/// Residuals on a grid, with the models of a reference shape's (§5.3.4).
class GridResiduals {
 public:
  GridResiduals() { running_.fill(16 << 8); }

  /// Begins another value.
  void begin_value() { others_ = 0; }

  /// Codes the residual of the integer with this number; what a damaged stream yields is within +-2^27.
  template <class Coder>
  std::int32_t code(Coder& coder, std::size_t number, const ResidualOutlook& outlook, std::int32_t residual) {
    std::int64_t& running = running_[number];
    const std::int64_t around = outlook.near > 0 ? (outlook.beside << 8) / outlook.near : running;
    const std::int64_t same = number == 0 ? around : others_ / static_cast<std::int64_t>(number);
    const auto spread = static_cast<std::int64_t>(std::min(outlook.spread, 0x1p24) * 256);
    const std::int64_t expected = 2 * running + 4 * around + 4 * same + 6 * spread;
    const std::int32_t coded = models_.code(coder, choice_of(outlook, spread, expected), residual);
    const std::int64_t size = std::int64_t{std::abs(coded)} << 8;
    others_ += size;
    running += (size - running) >> 5;
    return coded;
  }

 private:
  /// 3 log2 x, rounded down, for x from 1 to 2^24.
  static std::uint32_t thirds(std::int64_t x) {
    const auto octave = static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(x))) - 1;
    const std::uint32_t rest = static_cast<std::uint32_t>((x << 8) >> octave);
    return 3 * octave + (rest >= 323 ? 1 : 0) + (rest >= 406 ? 1 : 0);
  }

  static ShapeChoice choice_of(const ResidualOutlook& outlook, std::int64_t spread, std::int64_t expected) {
    std::int64_t size = (outlook.alone ? 2 * expected : expected) >> 4;
    int raw_bits = 0;
    for (; size > 640; size >>= 1) ++raw_bits;
    const std::int32_t lost = std::abs(outlook.lost);
    const std::int64_t wide = std::min(spread >> raw_bits, std::int64_t{1} << 24);
    return {thirds(std::max<std::int64_t>(size, 5)) - 6,
            lost >= 6   ? 2u
            : lost >= 2 ? 1u
                        : 0u,
            static_cast<std::uint32_t>(outlook.kind),
            wide < 77 ? 0 : std::min(15u, 1 + (thirds(wide) - 18) / 2),
            raw_bits,
            outlook.lost < 0};
  }

  std::array<std::int64_t, kMaxAttributeComponents> running_{};  ///< mean size of each integer's, in 1/256
  std::int64_t others_ = 0;  ///< sizes of the residuals of this value so far, in 1/256
  ShapeModels models_;
};

/// Residuals of ordered integers, by the number of their bits.
class ExactResiduals {
 public:
  void begin_value() { before_ = kNone; }

  /// Sizes beside are numbers of bits. The residual is a difference modulo 2^32.
  template <class Coder>
  std::int32_t code(Coder& coder, const ResidualOutlook& outlook, std::int32_t residual) {
    const bool given = static_cast<std::uint32_t>(residual) >> 31 != 0;
    const std::uint32_t size =
        given ? 0u - static_cast<std::uint32_t>(residual) : static_cast<std::uint32_t>(residual);
    const std::uint32_t mean =
        outlook.near > 0 ? static_cast<std::uint32_t>(outlook.beside / outlook.near) : kNone;
    const std::uint32_t length = code_length(coder, mean, static_cast<std::uint32_t>(std::bit_width(size)));
    before_ = length;
    if (length == 0) return 0;
    const bool negative = coder.code(sign_[length], given);
    const int below = static_cast<int>(length) - 1;
    const std::uint32_t coded = 1u << below | code_bits(coder, size & ((1u << below) - 1), below);
    return static_cast<std::int32_t>(negative ? 0u - coded : coded);
  }

  static std::int32_t size_of(std::int32_t residual) {
    const auto bits = static_cast<std::uint32_t>(residual);
    return std::bit_width(bits >> 31 != 0 ? 0u - bits : bits);
  }

 private:
  static constexpr std::uint32_t kNone = 33;  ///< no length is known

  /// Lengths near the one expected are symbols 1 to 14, others go raw.
  template <class Coder>
  std::uint32_t code_length(Coder& coder, std::uint32_t mean, std::uint32_t length) {
    const std::uint32_t base = mean != kNone ? mean : before_ != kNone ? before_ : 24;
    const std::uint32_t place = length + 9 - base;  // wraps around where it is below
    const std::uint32_t symbol =
        coder.code(by_mean_[mean], by_before_[before_], place >= 1 && place <= 14 ? place : 15);
    if (symbol == 0 || symbol == 15) return std::min(coder.code_raw(length, 6), 32u);
    return std::min(base + symbol < 9 ? 0 : base + symbol - 9, 32u);
  }

  std::uint32_t before_ = kNone;  ///< the length before in this value
  std::vector<AdaptiveSymbol> by_mean_{34}, by_before_{34};
  std::array<AdaptiveBit, 33> sign_;  ///< [length]
};

}  // namespace tvg
