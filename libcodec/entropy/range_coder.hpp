#pragma once
#include "entropy/adaptive_models.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The arithmetic coder (format-spec §6.1) with the same call on both sides: `code(model, value)` writes the
// value and returns it when encoding, ignores the argument and returns the value read when decoding. Code
// above this layer is written once, as a template over the coder, and so cannot fall out of step.
namespace tvg {

/// Writes symbols. `range` stays in [2^31, 2^32) after every symbol, so that a frequency is never rounded by
/// more than 2^-16 of itself.
class RangeEncoder {
 public:
  static constexpr bool kDecoding = false;

  /// Codes one symbol of an adaptive alphabet and adapts the model.
  std::uint32_t code(AdaptiveSymbol& model, std::uint32_t symbol) {
    encode(SymbolMixture::interval_of(model, model, symbol));
    model.adapt(symbol);
    return symbol;
  }

  /// Codes one symbol with the mean of two different models and adapts both.
  std::uint32_t code(AdaptiveSymbol& a, AdaptiveSymbol& b, std::uint32_t symbol) {
    encode(SymbolMixture::interval_of(a, b, symbol));
    a.adapt(symbol);
    b.adapt(symbol);
    return symbol;
  }

  /// Codes one bit and adapts the model.
  bool code(AdaptiveBit& model, bool bit) {
    code_bit(model.zero_frequency(), bit);
    model.adapt(bit);
    return bit;
  }

  /// Codes one bit, zero with the given frequency out of 1 << 15.
  bool code_bit(std::uint32_t zero_frequency, bool bit) {
    encode(bit ? zero_frequency : 0, bit ? (1u << kProbabilityBits) - zero_frequency : zero_frequency);
    return bit;
  }

  /// Codes `count` (0 to 15) equally likely bits, value < 2^count.
  std::uint32_t code_raw(std::uint32_t value, int count) {
    encode(value << (kProbabilityBits - count), 1u << (kProbabilityBits - count));
    return value;
  }

  /// Ends the stream and returns its bytes; the encoder is then empty, ready for another stream.
  std::vector<std::uint8_t> finish();

 private:
  void encode(const SymbolMixture::Interval& interval) { encode(interval.low, interval.high - interval.low); }
  void encode(std::uint32_t cumulative, std::uint32_t frequency) {
    const std::uint32_t unit = range_ >> kProbabilityBits;
    low_ += static_cast<std::uint64_t>(unit) * cumulative;
    range_ = unit * frequency;
    const int shift =
        std::countl_zero(range_);  // at most 15: a frequency is at least 1, a unit at least 2^16
    range_ <<= shift;
    low_ <<= shift;
    pending_ += shift;
    if (pending_ >= 8) put_bytes();
  }
  void put_bytes();

  std::uint64_t low_ = 0;  ///< 32 bits below the point, `pending_` bits (and a carry) above it
  std::uint32_t range_ = 0xFFFFFFFFu;
  int pending_ = 0;  ///< bits settled but for a carry, not yet in bytes_
  std::vector<std::uint8_t> bytes_;
};

/// Reads symbols from bytes it does not own. It never reads past their end: zero bits follow the last byte,
/// and finished() tells afterwards whether exactly these bytes are what an encoder would have written.
class RangeDecoder {
 public:
  static constexpr bool kDecoding = true;

  explicit RangeDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) { refill(); }

  std::uint32_t code(AdaptiveSymbol& model, std::uint32_t /*ignored*/ = 0) {
    const std::uint32_t symbol = decode(SymbolMixture(model, model));
    model.adapt(symbol);
    return symbol;
  }

  std::uint32_t code(AdaptiveSymbol& a, AdaptiveSymbol& b, std::uint32_t /*ignored*/ = 0) {
    const std::uint32_t symbol = decode(SymbolMixture(a, b));
    a.adapt(symbol);
    b.adapt(symbol);
    return symbol;
  }

  bool code(AdaptiveBit& model, bool /*ignored*/ = false) {
    const bool bit = code_bit(model.zero_frequency());
    model.adapt(bit);
    return bit;
  }

  bool code_bit(std::uint32_t zero_frequency, bool /*ignored*/ = false) {
    const std::uint32_t unit = range_ >> kProbabilityBits;
    const auto code = static_cast<std::uint32_t>(window_ >> 32);
    impossible_ |= code >= (unit << kProbabilityBits);
    const bool bit = code >= unit * zero_frequency;
    if (bit) {
      consume(unit, zero_frequency, (1u << kProbabilityBits) - zero_frequency);
    } else {
      consume(unit, 0, zero_frequency);
    }
    return bit;
  }

  std::uint32_t code_raw(std::uint32_t /*ignored*/, int count) {
    const std::uint32_t unit = range_ >> kProbabilityBits;
    const int shift = kProbabilityBits - count;
    const std::uint32_t value = target(unit) >> shift;
    consume(unit, value << shift, 1u << shift);
    return value;
  }

  /// Bits used so far, with the fraction that the range tells.
  double used_bits() const {
    return 8.0 * static_cast<double>(next_) - available_ + 32 - std::log2(static_cast<double>(range_));
  }

  /// True once more bits were used than the bytes hold, or no encoder can have written them: what is decoded
  /// from here on is meaningless.
  bool overrun() const { return overrun_ || impossible_; }

  /// After the last symbol: true when the stream ends exactly here, in the one form the encoder writes
  /// (§6.1).
  bool finished() const;

 private:
  std::uint32_t decode(const SymbolMixture& mixture) {
    const std::uint32_t unit = range_ >> kProbabilityBits;
    const SymbolMixture::Interval interval = mixture.find(target(unit));
    consume(unit, interval.low, interval.high - interval.low);
    return interval.symbol;
  }

  /// Where in the probability scale the code value lies.
  std::uint32_t target(std::uint32_t unit) {
    const std::uint32_t quotient = static_cast<std::uint32_t>(window_ >> 32) / unit;
    impossible_ |= quotient >= (1u << kProbabilityBits);
    return quotient < (1u << kProbabilityBits) ? quotient : (1u << kProbabilityBits) - 1;
  }

  void consume(std::uint32_t unit, std::uint32_t cumulative, std::uint32_t frequency) {
    window_ -= static_cast<std::uint64_t>(unit * cumulative) << 32;
    range_ = unit * frequency;
    const int shift = std::countl_zero(range_);
    range_ <<= shift;
    window_ <<= shift;
    available_ -= shift;
    if (available_ < 32) refill();
  }

  void refill();

  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;      ///< bytes taken into the window, counting imagined zero bytes after the end
  std::uint64_t window_ = 0;  ///< upper 32 bits: code value minus low; below them the bits that follow
  int available_ = 0;         ///< bits of the window that are filled
  std::uint32_t range_ = 0xFFFFFFFFu;
  bool impossible_ = false;  ///< the code value lay beyond every interval: no encoder writes that
  bool overrun_ = false;
};

}  // namespace tvg
