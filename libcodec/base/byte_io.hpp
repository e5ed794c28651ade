#pragma once
#include "base/bits.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

// Primitive types of the format (format-spec §2): little-endian integers, binary64, and varints in shortest
// form.
namespace tvg {

using Bytes = std::span<const std::uint8_t>;

/// Appends primitive values to a byte vector.
class ByteWriter {
 public:
  void u8(std::uint8_t value) { bytes_.push_back(value); }
  void u16(std::uint16_t value) { little_endian(value, 2); }
  void u32(std::uint32_t value) { little_endian(value, 4); }
  void u64(std::uint64_t value) { little_endian(value, 8); }
  void f64(double value) { u64(bits_as<std::uint64_t>(value)); }
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) u8(static_cast<std::uint8_t>(value | 0x80));
    u8(static_cast<std::uint8_t>(value));
  }
  void bytes(Bytes source) { bytes_.insert(bytes_.end(), source.begin(), source.end()); }

  const std::vector<std::uint8_t>& data() const { return bytes_; }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  void little_endian(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) u8(static_cast<std::uint8_t>(value >> (8 * i)));
  }

  std::vector<std::uint8_t> bytes_;
};

/// Reads primitive values and never past the end: the first read that does not fit, and everything after it,
/// yields zero and makes ok() false.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes = {}) : bytes_(bytes) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(little_endian(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(little_endian(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(little_endian(4)); }
  std::uint64_t u64() { return little_endian(8); }
  double f64() { return bits_as<double>(u64()); }

  /// Refuses a varint that is not in its shortest form or does not fit 64 bits (format-spec §2.2).
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const std::uint8_t byte = u8();
      const std::uint64_t low = byte & 0x7Fu;
      if ((shift == 63 && low > 1) || (shift > 0 && byte == 0)) break;
      value |= low << shift;
      if (byte < 0x80) return ok_ ? value : 0;
    }
    ok_ = false;
    return 0;
  }

  /// The next `count` bytes, not copied; empty when there are fewer.
  Bytes bytes(std::uint64_t count) {
    if (count > left()) {
      ok_ = false;
      return {};
    }
    const Bytes result = bytes_.subspan(position_, static_cast<std::size_t>(count));
    position_ += result.size();
    return result;
  }

  bool ok() const { return ok_; }
  std::size_t position() const { return position_; }
  std::size_t left() const { return bytes_.size() - position_; }
  /// True when everything was read, to the last byte.
  bool finished() const { return ok_ && left() == 0; }

 private:
  std::uint64_t little_endian(std::size_t count) {
    if (!ok_ || count > left()) {
      ok_ = false;
      return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= std::uint64_t{bytes_[position_ + i]} << (8 * i);
    position_ += count;
    return value;
  }

  Bytes bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace tvg
