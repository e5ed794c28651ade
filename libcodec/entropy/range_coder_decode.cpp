#include "entropy/range_coder.hpp"

namespace tvg {

std::uint64_t RangeDecoder::last_word(std::span<const std::uint8_t> bytes, StreamEnd end, std::size_t next) {
  std::uint64_t word = 0;
  for (std::size_t i = next; i < next + 8; ++i) {
    const std::size_t place = end == StreamEnd::kFront ? i : bytes.size() - 1 - i;
    word = word << 8 | (i < bytes.size() ? bytes[place] : 0u);
  }
  return word;
}

// format-spec §6.1
std::size_t RangeDecoder::final_bytes() const {
  const std::size_t used_bits = shifted() + 1;
  const std::size_t size = (used_bits + 7) / 8;
  if (size > bytes_.size()) return 0;
  // The 14 bits behind those used are part of the code value, and nothing to go by.
  const std::uint64_t word = last_word(bytes_, end_, used_bits / 8) << used_bits % 8;
  const auto behind = static_cast<std::uint32_t>(word >> 50);
  const std::size_t padding = 8 * size - used_bits;
  const bool padding_is_zero = word >> 1 >> (63 - padding) == 0;
  return padding_is_zero && current() - behind < 1u << 14 ? size : 0;
}

}  // namespace tvg
