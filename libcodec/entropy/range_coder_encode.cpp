#include "entropy/range_coder.hpp"

namespace tvg {

/// Puts out what is settled but for a carry.
void RangeEncoder::put_bytes() {
  while (pending_ >= 8) {
    pending_ -= 8;
    const int position = 32 + pending_;
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
  // The one multiple of 2^31 in [low, low + 2^31) lies in the final interval: one bit more settles it.
  constexpr std::uint64_t kHalf = std::uint64_t{1} << 31;
  low_ = (low_ + kHalf - 1) & ~(kHalf - 1);
  low_ <<= 1;
  ++pending_;
  if (pending_ >= 8) put_bytes();
  if (pending_ > 0) {  // fill the last byte with zero bits
    low_ <<= 8 - pending_;
    pending_ = 8;
    put_bytes();
  }
  std::vector<std::uint8_t> bytes = std::move(bytes_);
  *this = RangeEncoder();
  return bytes;
}

}  // namespace tvg
