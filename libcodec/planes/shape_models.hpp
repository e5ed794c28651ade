#pragma once
#include "entropy/adaptive_models.hpp"
#include "entropy/code_bits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

// How a reference shape's residual is coded (format-spec §5.3): as bits, each under the logistic mixture of
// estimates from several contexts.
namespace tvg {

/// Log odds that a probability of 12 bits may have, in 1/256, either sign.
inline constexpr int kMostLogOdds = 2047;

/// The logistic function: the probability, in [1, 4095], for log odds in [-kMostLogOdds, kMostLogOdds].
constexpr int squash(int log_odds) {
  // 4096 / (1 + exp(-x / 2)) for x from -16 to 16, within [1, 4095].
  constexpr std::array<int, 33> kCurve = {1,    2,    4,    6,    10,   17,   28,   45,   74,   120,  194,
                                          311,  488,  747,  1102, 1546, 2048, 2550, 2994, 3349, 3608, 3785,
                                          3902, 3976, 4022, 4051, 4068, 4079, 4086, 4090, 4092, 4094, 4095};
  const int place = log_odds + 2048, part = place & 127;
  const auto below = static_cast<std::size_t>(place >> 7);
  return (kCurve[below] * (128 - part) + kCurve[below + 1] * part + 64) >> 7;
}

/// Its inverse, [probability]: the smallest log odds whose probability is not below it.
inline constexpr std::array<std::int16_t, 4096> kLogOdds = [] {
  std::array<std::int16_t, 4096> stretched{};
  int log_odds = -kMostLogOdds;
  for (int p = 0; p < 4096; ++p) {
    while (log_odds < kMostLogOdds && squash(log_odds) < p) ++log_odds;
    stretched[static_cast<std::size_t>(p)] = static_cast<std::int16_t>(log_odds);
  }
  return stretched;
}();

/// What is known about a residual before it is coded: where its estimates stand.
struct ShapeChoice {
  static constexpr std::size_t kContexts = 5;

  std::array<std::uint32_t, kContexts> contexts;  ///< [estimate], below kSizes
  std::uint32_t level;                            ///< below kLevels: expected size
  int raw_bits;                                   ///< low bits that go without a model
  bool mirrored;                                  ///< the residual's sign is turned round
};

class ShapeModels {
 public:
  static constexpr std::uint32_t kLevels = 32;
  static constexpr std::array<std::uint32_t, ShapeChoice::kContexts> kSizes = {192, 64, 48, 12, 192};

  ShapeModels() {
    for (auto& weights : weights_) weights.fill(kFirstWeight);
  }

  /// Codes one residual and returns it; a decoder ignores the argument. What a damaged stream yields is
  /// within +-2^27.
  template <class Coder>
  std::int32_t code(Coder& coder, const ShapeChoice& choice, std::int32_t residual) {
    const std::int32_t turned = choice.mirrored ? -residual : residual;
    const std::int32_t high = code_high(coder, choice, turned >> choice.raw_bits);
    const std::uint32_t mask = (1u << choice.raw_bits) - 1;
    const std::uint32_t low = code_bits(coder, static_cast<std::uint32_t>(turned) & mask, choice.raw_bits);
    const std::int64_t value = high * (std::int64_t{1} << choice.raw_bits) + low;
    const auto bounded = static_cast<std::int32_t>(std::clamp<std::int64_t>(value, -kBound, kBound));
    return choice.mirrored ? -bounded : bounded;
  }

 private:
  static constexpr std::int32_t kBound = 1 << 27;
  static constexpr std::uint32_t kSteps = 20;         ///< sizes 1 to kSteps are told apart one by one
  static constexpr std::size_t kBins = 2 + kSteps;    ///< not zero, positive, above 1, above 2, ...
  static constexpr std::int32_t kFirstWeight = 4915;  ///< 0.3
  static constexpr std::int32_t kMostWeight = 1 << 16;
  static constexpr int kLimit = 250;

  struct Estimate {
    std::uint16_t one = 1 << 15;  ///< probability of a one
    std::uint16_t count = 0;
  };
  using Weights = std::array<std::int32_t, ShapeChoice::kContexts>;

  template <class Coder>
  std::int32_t code_high(Coder& coder, const ShapeChoice& choice, std::int32_t wanted) {
    if (!code_bin(coder, choice, 0, wanted != 0)) return 0;
    const bool positive = code_bin(coder, choice, 1, wanted > 0);
    const auto size = static_cast<std::uint32_t>(std::abs(wanted));
    std::uint32_t coded = 1;
    while (coded <= kSteps && code_bin(coder, choice, coded + 1, size > coded)) ++coded;
    if (coded > kSteps) coded = code_escaped(coder, size);
    const auto value = static_cast<std::int32_t>(coded);
    return positive ? value : -value;
  }

  template <class Coder>
  bool code_bin(Coder& coder, const ShapeChoice& choice, std::size_t bin, bool bit) {
    std::array<Estimate*, ShapeChoice::kContexts> estimates;
    std::array<int, ShapeChoice::kContexts> odds;
    Weights& weights = weights_[bin * kLevels / 4 + choice.level / 4];
    std::int32_t sum = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < ShapeChoice::kContexts; ++i) {
      estimates[i] = &estimates_[(begin + choice.contexts[i]) * kBins + bin];
      begin += kSizes[i];
      odds[i] = kLogOdds[estimates[i]->one >> 4];
      sum += weights[i] * odds[i];
    }
    const int one = squash(std::clamp(sum >> 14, -kMostLogOdds, kMostLogOdds));
    bit = coder.code_bit(static_cast<std::uint32_t>(4096 - one) << 3, bit);
    const int error = (bit ? 4096 : 0) - one;
    for (std::size_t i = 0; i < ShapeChoice::kContexts; ++i) {
      weights[i] = std::clamp(weights[i] + ((odds[i] * error + (1 << 11)) >> 12), -kMostWeight, kMostWeight);
      adapt(*estimates[i], bit);
    }
    return bit;
  }

  static void adapt(Estimate& estimate, bool bit) {
    const int one = estimate.one, goal = bit ? 65535 : 0;
    const int moved = one + (((goal - one) * kRates[estimate.count]) >> 16);
    estimate.one = static_cast<std::uint16_t>(std::clamp(moved, 32, 65503));
    if (estimate.count < kLimit) ++estimate.count;
  }

  /// Sizes beyond kSteps: Elias' gamma code of what is beyond, its length adaptive.
  template <class Coder>
  [[gnu::noinline]] std::uint32_t code_escaped(Coder& coder, std::uint32_t size) {
    const std::uint32_t beyond = std::max<std::uint32_t>(size, kSteps + 1) - kSteps;
    const int wanted = std::bit_width(beyond) - 1;
    int length = 0;
    while (length < static_cast<int>(escape_length_.size()) &&
           coder.code(escape_length_[static_cast<std::size_t>(length)], length < wanted)) {
      ++length;
    }
    const std::uint32_t value = (1u << length) | code_bits(coder, beyond, length);
    return std::min<std::uint32_t>(value + kSteps, kBound);
  }

  /// 65536 / (count + 1.6)
  static constexpr std::array<std::int32_t, kLimit + 1> kRates = [] {
    std::array<std::int32_t, kLimit + 1> rates{};
    for (std::size_t n = 0; n < rates.size(); ++n)
      rates[n] = static_cast<std::int32_t>((655360 + 5 * n + 8) / (10 * n + 16));
    return rates;
  }();

  std::array<Estimate, (192 + 64 + 48 + 12 + 192) * kBins> estimates_;
  std::array<Weights, kBins * kLevels / 4> weights_;
  std::array<AdaptiveBit, 26> escape_length_;
};

}  // namespace tvg
