#pragma once
#include "entropy/adaptive_models.hpp"

#include <algorithm>
#include <cstdint>

namespace tvg {

/// Codes a number of `count` (0 to 32) equally likely bits, the most significant first, in pieces of at
/// most 15.
template <class Coder>
std::uint32_t code_bits(Coder& coder, std::uint32_t value, int count) {
  std::uint32_t coded = 0;
  for (int left = count; left > 0;) {
    const int bits = std::min(left, kProbabilityBits);
    left -= bits;
    coded = (coded << bits) | coder.code_raw((value >> left) & ((1u << bits) - 1), bits);
  }
  return coded;
}

}  // namespace tvg
