#include "entropy/range_coder.hpp"

namespace tvg {

/// Puts out what is settled but for a carry.
void RangeEncoder::put_bytes() {
  while (pending_ >= 8) {
    pending_ -= 8;
    const int position = 16 + pending_;
    if ((low_ >> (position + 8)) != 0) {  // a carry runs into bytes already written
      std::size_t i = bytes_.size();
      while (++bytes_[--i] == 0) {
      }
    }
    bytes_.push_back(static_cast<std::uint8_t>(low_ >> position));
    low_ &= (std::uint64_t{1} << position) - 1;
  }
}

std::vector<std::uint8_t> RangeEncoder::finish() {
  // One multiple of 2^14 lies in [low, low + 2^14): whatever follows its last 14 bits, it lies in the final
  // interval.
  constexpr std::uint64_t kQuarter = std::uint64_t{1} << 14;
  low_ = (low_ + kQuarter - 1) & ~(kQuarter - 1);
  const int whole_bytes =
      (pending_ + 9) / 8 * 8;  // with two bits more, and zero bits that fill the last byte
  low_ <<= whole_bytes - pending_;
  pending_ = whole_bytes;
  put_bytes();
  std::vector<std::uint8_t> bytes = std::move(bytes_);
  *this = RangeEncoder();
  return bytes;
}

}  // namespace tvg
