#pragma once
#include "entropy/adaptive_models.hpp"
#include "entropy/code_bits.hpp"
#include "entropy/kept_coder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

// A residual as a symbol of 16 under the mean of two adaptive models, with low bits that go raw and an escape
// for what is large (format-spec §7.3.2).
namespace tvg::residual_alphabet {

inline constexpr std::int32_t kLargest = 7;  ///< symbols 0 to 14 are -7 to 7
inline constexpr std::uint32_t kEscape = 15;
/// What a damaged stream yields is within this and its negative.
inline constexpr std::int32_t kBound = 1 << 27;

/// Models of how far beyond the alphabet a residual is.
using EscapeLength = std::array<AdaptiveBit, 27>;

/// The symbol of a residual whose low bits are gone.
constexpr std::uint32_t symbol_of(std::int32_t residual) {
  const bool fits = residual >= -kLargest && residual <= kLargest;
  return fits ? static_cast<std::uint32_t>(residual + kLargest) : kEscape;
}

/// A model in which symbols are as likely as these shares say, which are below 2^48 each.
inline AdaptiveSymbol model_of(const std::array<std::uint64_t, AdaptiveSymbol::kMaxSymbols>& shares,
                               std::uint8_t seen) {
  std::uint64_t sum = 0;
  for (const std::uint64_t share : shares) sum += share;
  std::array<std::uint16_t, AdaptiveSymbol::kMaxSymbols> weights{};
  for (std::size_t i = 0; i < weights.size(); ++i)
    weights[i] = static_cast<std::uint16_t>(shares[i] * 0xFFFF / sum);
  return AdaptiveSymbol(weights, seen);
}

/// Sizes that the alphabet does not reach: a sign, then Elias' gamma code of what is beyond, its length
/// adaptive.
template <class Coder>
[[gnu::noinline]] std::int32_t code_escaped(Coder& coder, EscapeLength& escape_length,
                                            std::int32_t residual) {
  const bool negative = coder.code_raw(residual < 0 ? 1 : 0, 1) != 0;
  const auto beyond = static_cast<std::uint32_t>(std::max(std::abs(residual) - kLargest, 1));
  const int wanted_length = std::bit_width(beyond) - 1;
  int length = 0;
  while (length < static_cast<int>(escape_length.size()) &&
         coder.code(escape_length[static_cast<std::size_t>(length)], length < wanted_length)) {
    ++length;
  }
  const std::uint32_t value = (1u << length) | code_bits(coder, beyond, length);
  const auto size = static_cast<std::int32_t>(std::min<std::uint32_t>(value + kLargest, kBound));
  return negative ? -size : size;
}

/// About how many bits that takes.
constexpr int escaped_bits(std::int32_t residual) {
  const auto beyond =
      static_cast<std::uint32_t>(std::max((residual < 0 ? -residual : residual) - kLargest, 1));
  return 2 * std::bit_width(beyond);
}

/// What a residual's symbol does not say; `high` is the symbol less kLargest. Around large residuals the low
/// bits are all alike: `raw_bits` of them, up to 15, go without a model. Returns the residual; a decoder
/// ignores the last argument.
template <class Coder>
[[gnu::always_inline]] inline std::int32_t code_rest(Coder& coder, std::int32_t high,
                                                     EscapeLength& escape_length, int raw_bits,
                                                     std::int32_t residual) {
  if (high > kLargest)
    high = apart(coder, [&](Coder& cold) { return code_escaped(cold, escape_length, residual >> raw_bits); });
  if (raw_bits == 0) return high;
  const std::uint32_t low =
      coder.code_raw(static_cast<std::uint32_t>(residual) & ((1u << raw_bits) - 1), raw_bits);
  const std::int64_t value = high * (std::int64_t{1} << raw_bits) + low;
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, -kBound, kBound));
}

/// Codes a residual and returns it; a decoder ignores the argument.
template <class Coder>
std::int32_t code(Coder& coder, AdaptiveSymbol& first, AdaptiveSymbol& second, EscapeLength& escape_length,
                  int raw_bits, std::int32_t residual) {
  const std::uint32_t symbol = coder.code(first, second, symbol_of(residual >> raw_bits));
  return code_rest(coder, static_cast<std::int32_t>(symbol) - kLargest, escape_length, raw_bits, residual);
}

}  // namespace tvg::residual_alphabet
