#pragma once
#include "entropy/adaptive_models.hpp"
#include "entropy/code_bits.hpp"
#include "planes/residual_alphabet.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

// How a reference shape's residual is coded (format-spec §5.3.4): the alphabet of residuals, whose models
// begin with the distribution that the expected size lets expect.
namespace tvg {

/// What is known about a residual before it is coded.
struct ShapeChoice {
  std::uint32_t level;   ///< 0 to ShapeModels::kLevels - 1: its expected size
  std::uint32_t lost;    ///< 0 to 2: how much rounding took from the prediction
  std::uint32_t kind;    ///< 0 to 3: the number of parallelograms, up to 3
  std::uint32_t around;  ///< 0 to 15: sizes at the neighbours
  int raw_bits;          ///< low bits that go without these models
  bool mirrored;         ///< the residual's sign is turned round
};

class ShapeModels {
 public:
  static constexpr std::size_t kLevels = 22;

  ShapeModels() {
    for (std::size_t i = 0; i < first_.size(); ++i) first_[i] = model_of(i / 3 % kLevels);
    for (std::size_t i = 0; i < second_.size(); ++i) {
      const std::size_t around = i % 16, alone = i < 16 ? 5 : 0;
      second_[i] = model_of(std::min(2 * around + 10 + alone, kLevels - 1));
    }
  }

  /// Codes one residual and returns it; a decoder ignores the argument. What a damaged stream yields is
  /// within +-2^27.
  template <class Coder>
  std::int32_t code(Coder& coder, const ShapeChoice& choice, std::int32_t residual) {
    const std::int32_t turned = choice.mirrored ? -residual : residual;
    const std::int32_t wanted = turned >> choice.raw_bits;
    const bool scaled = choice.raw_bits > 0;
    const std::uint32_t symbol =
        coder.code(first_[((scaled ? kLevels : 0) + choice.level) * 3 + choice.lost],
                   second_[choice.kind * 16 + choice.around], residual_alphabet::symbol_of(wanted));
    std::int32_t value = static_cast<std::int32_t>(symbol) - kLargest;
    if (symbol == kEscape)
      value = residual_alphabet::code_escaped(coder, escape_length_[scaled ? 1 : 0], wanted);
    if (scaled) value = code_low(coder, value, choice.raw_bits, turned);
    return choice.mirrored ? -value : value;
  }

 private:
  static constexpr std::int32_t kLargest = residual_alphabet::kLargest;
  static constexpr std::uint32_t kEscape = residual_alphabet::kEscape;

  /// [level]: how much less likely each size is than the one before, in 1/32768, where the mean is in the
  /// middle of the level: 5/256 2^((level + 1/2) / 3).
  static constexpr std::array<std::uint16_t, kLevels> kFall = {
      359,  452,  570,  718,  904,   1139,  1434,  1805,  2270,  2852,  3577,
      4476, 5580, 6918, 8508, 10348, 12406, 14616, 16885, 19111, 21207, 23109};

  /// Two-sided geometric; the sizes that the alphabet does not reach are the escape's.
  static AdaptiveSymbol model_of(std::size_t level) {
    const std::uint64_t fall = kFall[level];
    std::array<std::uint64_t, kEscape + 1> share{};
    std::uint64_t size = 1 << 20;
    for (std::size_t i = 0; i <= kLargest; ++i) {
      share[kLargest + i] = share[kLargest - i] = size;
      size = size * fall >> 15;
    }
    share[kEscape] = 2 * (size << 15) / (32768 - fall);
    return residual_alphabet::model_of(share, 0);
  }

  /// The low bits below `high`, of which only the first leans to one side.
  template <class Coder>
  std::int32_t code_low(Coder& coder, std::int32_t high, int raw_bits, std::int32_t turned) {
    const auto wanted = static_cast<std::uint32_t>(turned) & ((1u << raw_bits) - 1);
    const auto place = static_cast<std::size_t>(std::clamp(high, -kLargest - 1, kLargest + 1) + kLargest + 1);
    const bool top = coder.code(top_[place], (wanted >> (raw_bits - 1)) != 0);
    const std::uint32_t rest = code_bits(coder, wanted & ((1u << (raw_bits - 1)) - 1), raw_bits - 1);
    const std::int64_t low = (std::int64_t{top} << (raw_bits - 1)) + rest;
    const std::int64_t value = high * (std::int64_t{1} << raw_bits) + low;
    return static_cast<std::int32_t>(
        std::clamp<std::int64_t>(value, -residual_alphabet::kBound, residual_alphabet::kBound));
  }

  std::array<AdaptiveSymbol, 2 * kLevels * 3> first_;             ///< [scaled][level][lost]
  std::array<AdaptiveSymbol, 4 * 16> second_;                     ///< [kind][around]
  std::array<residual_alphabet::EscapeLength, 2> escape_length_;  ///< [scaled]
  std::array<AdaptiveBit, 2 * kLargest + 3> top_;                 ///< [high]
};

}  // namespace tvg
