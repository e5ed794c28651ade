#pragma once
#include "entropy/range_coder.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Two range-coder streams in one run of bytes (format-spec §6.1.1): one is read from its front, the other
// from its back, and neither needs to know where they meet. What is coded side by side takes turns between
// them, so that a decoder works at two symbols at a time instead of waiting for each one.
namespace tvg {

/// Writes both streams.
class TwoEndedEncoder {
 public:
  static constexpr bool kDecoding = false;

  /// The coder of what has this number among the things that are coded side by side.
  RangeEncoder& lane(std::size_t number) { return number % 2 == 0 ? front_ : back_; }

  /// Ends both streams and returns their bytes; the encoder is then empty, ready for others.
  std::vector<std::uint8_t> finish() {
    std::vector<std::uint8_t> bytes = front_.finish();
    const std::vector<std::uint8_t> back = back_.finish();
    bytes.insert(bytes.end(), back.rbegin(), back.rend());
    return bytes;
  }

 private:
  RangeEncoder front_, back_;
};

/// Reads both streams from bytes it does not own, and never past their ends.
class TwoEndedDecoder {
 public:
  static constexpr bool kDecoding = true;

  explicit TwoEndedDecoder(std::span<const std::uint8_t> bytes)
      : size_(bytes.size()), front_(bytes, StreamEnd::kFront), back_(bytes, StreamEnd::kBack) {}

  /// The coder of what has this number among the things that are coded side by side.
  RangeDecoder& lane(std::size_t number) { return number % 2 == 0 ? front_ : back_; }

  /// Bits of both used so far.
  double used_bits() const { return front_.used_bits() + back_.used_bits(); }

  /// True once more bits were used than the bytes hold: what is decoded from here on is meaningless.
  bool overrun() const { return front_.shifted() + back_.shifted() > 8 * size_; }

  /// After the last symbol: true when the streams meet, each in the one form the encoder writes.
  bool finished() const {
    const std::size_t front = front_.final_bytes(), back = back_.final_bytes();
    return front > 0 && back > 0 && front + back == size_;
  }

 private:
  std::size_t size_;
  RangeDecoder front_, back_;
};

}  // namespace tvg
