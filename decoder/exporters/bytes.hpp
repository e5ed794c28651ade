#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

namespace tvg::cli {

/// Stores 32 bits of a number in the given byte order.
inline void store32(char* bytes, std::uint32_t value, bool big_endian) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[big_endian ? 3 - i : i] = static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
}

inline void store32(char* bytes, float value, bool big_endian) {
  store32(bytes, std::bit_cast<std::uint32_t>(value), big_endian);
}

}  // namespace tvg::cli
