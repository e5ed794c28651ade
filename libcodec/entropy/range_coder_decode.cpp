#include "entropy/range_coder.hpp"

namespace tvg {

void RangeDecoder::refill() {
  while (available_ <= 56) {
    const std::uint64_t byte = next_ < bytes_.size() ? bytes_[next_] : 0;
    window_ |= byte << (56 - available_);
    available_ += 8;
    ++next_;
  }
  const std::size_t used_bits = 8 * next_ - static_cast<std::size_t>(available_);
  overrun_ = overrun_ || used_bits > 8 * bytes_.size();
}

bool RangeDecoder::finished() const {
  const std::size_t used_bits = 8 * next_ - static_cast<std::size_t>(available_) + 1;
  if (overrun() || bytes_.size() != (used_bits + 7) / 8) return false;
  const std::size_t padding = 8 * bytes_.size() - used_bits;
  const bool padding_is_zero = (bytes_.back() & ((1u << padding) - 1)) == 0;
  return padding_is_zero && (window_ >> 63) == 0;
}

}  // namespace tvg
