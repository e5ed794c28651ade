#pragma once
#include "base/bits.hpp"
#include "entropy/adaptive_models.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The arithmetic coder (format-spec §6.1) with the same call on both sides: `code(model, value)` writes the
// value and returns it when encoding, ignores the argument and returns the value read when decoding. Code
// above this layer is written once, as a template over the coder, and so cannot fall out of step.
namespace tvg {

/// By how many bits a range, which is below 2^16 and not zero, is shifted to be 2^15 or more.
inline int normalizing(std::uint32_t range) {
  return static_cast<int>(15 ^ highest_bit(range));
}

/// Writes symbols. `range` is 2^15 at first and from 2^15 to 2^16 - 1 later; the least probable symbols of a
/// model are 8 times as probable as 2^-16.
class RangeEncoder {
 public:
  static constexpr bool kDecoding = false;

  /// Codes one symbol of an adaptive alphabet and adapts the model.
  std::uint32_t code(AdaptiveSymbol& model, std::uint32_t symbol) {
    encode(SymbolMixture::interval_of(model, model, symbol, range_));
    model.adapt(symbol);
    return symbol;
  }

  /// Codes one symbol with the mean of two different models and adapts both.
  std::uint32_t code(AdaptiveSymbol& a, AdaptiveSymbol& b, std::uint32_t symbol) {
    encode(SymbolMixture::interval_of(a, b, symbol, range_));
    const AdaptiveSymbol::Goals goals(symbol);
    a.adapt(goals);
    b.adapt(goals);
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
    const std::uint32_t boundary = range_ * zero_frequency >> kProbabilityBits;
    encode(bit ? SymbolMixture::Interval{boundary, range_} : SymbolMixture::Interval{0, boundary});
    return bit;
  }

  /// Codes `count` (0 to 15) equally likely bits, value < 2^count.
  std::uint32_t code_raw(std::uint32_t value, int count) {
    low_ = (low_ << count) + std::uint64_t{value} * range_;
    settle(count);
    return value;
  }

  /// Ends the stream and returns its bytes; the encoder is then empty, ready for another stream.
  std::vector<std::uint8_t> finish();

 private:
  void encode(const SymbolMixture::Interval& interval) {
    const std::uint32_t width = interval.high - interval.low;
    const int bits = normalizing(width);
    low_ = (low_ + interval.low) << bits;
    range_ = width << bits;
    settle(bits);
  }
  void settle(int bits) {
    pending_ += bits;
    if (pending_ >= 24) put_bytes();
  }
  void put_bytes();

  std::uint64_t low_ = 0;  ///< 16 bits below the point, `pending_` bits (and a carry) above it
  std::uint32_t range_ = 1u << 15;
  int pending_ = -1;  ///< bits settled but for a carry, not yet in bytes_; the first is always zero
  std::vector<std::uint8_t> bytes_;
};

/// From which end of the bytes a stream is read.
enum class StreamEnd : bool { kFront, kBack };

/// Reads symbols from bytes it does not own. It never reads past their end: zero bits follow the last byte,
/// and finished() tells afterwards whether exactly these bytes are what an encoder would have written.
class RangeDecoder {
 public:
  static constexpr bool kDecoding = true;

  explicit RangeDecoder(std::span<const std::uint8_t> bytes, StreamEnd end = StreamEnd::kFront)
      : bytes_(bytes), end_(end) {
    refill();
  }

  std::uint32_t code(AdaptiveSymbol& model, std::uint32_t /*ignored*/ = 0) {
    const SymbolMixture::Found found = SymbolMixture(model, model).find(range_, current());
    consume(found.interval);
    model.adapt(found.goals);
    return found.symbol;
  }

  [[gnu::always_inline]] std::uint32_t code(AdaptiveSymbol& a, AdaptiveSymbol& b,
                                            std::uint32_t /*ignored*/ = 0) {
    const SymbolMixture::Found found = SymbolMixture(a, b).find(range_, current());
    consume(found.interval);
    a.adapt(found.goals);
    b.adapt(found.goals);
    return found.symbol;
  }

  bool code(AdaptiveBit& model, bool /*ignored*/ = false) {
    const bool bit = code_bit(model.zero_frequency());
    model.adapt(bit);
    return bit;
  }

  bool code_bit(std::uint32_t zero_frequency, bool /*ignored*/ = false) {
    const std::uint32_t boundary = range_ * zero_frequency >> kProbabilityBits;
    const bool bit = current() >= boundary;
    consume(bit ? SymbolMixture::Interval{boundary, range_} : SymbolMixture::Interval{0, boundary});
    return bit;
  }

  std::uint32_t code_raw(std::uint32_t /*ignored*/, int count) {
    const int below = 48 - count;
    const std::uint32_t value = static_cast<std::uint32_t>(window_ >> below) / range_;
    window_ -= std::uint64_t{value} * range_ << below;
    shift(count);
    return value;
  }

  /// Bits used so far, with the fraction that the range tells.
  double used_bits() const {
    return static_cast<double>(shifted()) + 15 - std::log2(static_cast<double>(range_));
  }

  /// True once more bits were used than the bytes hold: what is decoded from here on is meaningless.
  bool overrun() const { return shifted() > 8 * bytes_.size(); }

  /// After the last symbol: true when the stream ends exactly with the last of the bytes, in the one form the
  /// encoder writes (§6.1).
  bool finished() const { return !bytes_.empty() && final_bytes() == bytes_.size(); }
  /// After the last symbol: how many bytes the stream has, whatever follows them; 0 where they are not what
  /// the encoder writes.
  std::size_t final_bytes() const;
  /// Bits used beyond the first 15.
  std::size_t shifted() const { return 8 * next_ + 1 - static_cast<std::size_t>(available_); }

 private:
  std::uint32_t current() const { return static_cast<std::uint32_t>(window_ >> 48); }

  void consume(const SymbolMixture::Interval& interval) {
    window_ -= std::uint64_t{interval.low} << 48;
    range_ = interval.high - interval.low;
    const int bits = normalizing(range_);
    range_ <<= bits;
    shift(bits);
  }

  void shift(int bits) {
    window_ <<= bits;
    available_ -= bits;
    if (available_ < 32) refill();
  }

  void refill() {
    std::uint64_t word = 0;
    if (next_ + 8 > bytes_.size()) [[unlikely]] {
      word = last_word(bytes_, end_, next_);
    } else if (end_ == StreamEnd::kFront) {
      const std::uint8_t* const from = bytes_.data() + next_;
      for (std::size_t i = 0; i < 8; ++i) word = word << 8 | from[i];
    } else {
      const std::uint8_t* const from = bytes_.data() + bytes_.size() - next_ - 8;
      for (std::size_t i = 8; i-- > 0;) word = word << 8 | from[i];
    }
    window_ |= word >> available_;
    const int count = (63 - available_) / 8;
    next_ += static_cast<std::size_t>(count);
    available_ += 8 * count;
  }
  /// Eight bytes from byte `next` of the stream on, zero bytes behind its end.
  static std::uint64_t last_word(std::span<const std::uint8_t> bytes, StreamEnd end, std::size_t next);

  std::span<const std::uint8_t> bytes_;
  StreamEnd end_;
  std::size_t next_ = 0;      ///< bytes taken into the window, counting imagined zero bytes after the end
  std::uint64_t window_ = 0;  ///< upper 16 bits: code value minus low; below them the bits that follow
  int available_ = 1;         ///< bits of the window that are filled, a zero in front of all others
  std::uint32_t range_ = 1u << 15;
};

}  // namespace tvg
