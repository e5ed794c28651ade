#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

namespace tvg::cli {

/// The scalar with its bytes in the opposite order.
template <class T>
T byte_swapped(T value) {
  if constexpr (sizeof(T) == 1) {
    return value;
  } else if constexpr (sizeof(T) == 2) {
    return std::bit_cast<T>(__builtin_bswap16(std::bit_cast<std::uint16_t>(value)));
  } else if constexpr (sizeof(T) == 4) {
    return std::bit_cast<T>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
  } else {
    return std::bit_cast<T>(__builtin_bswap64(std::bit_cast<std::uint64_t>(value)));
  }
}

/// Reads a scalar of the given byte order from unaligned bytes.
template <class T>
T load(const char* bytes, bool big_endian) {
  static_assert(std::is_arithmetic_v<T>);
  T value;
  std::memcpy(&value, bytes, sizeof value);
  const bool host_is_big = std::endian::native == std::endian::big;
  return big_endian == host_is_big ? value : byte_swapped(value);
}

/// float16 as float32.
inline float widened(std::uint16_t half) {
  const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000U) << 16;
  const int exponent = (half >> 10) & 31;
  const std::uint32_t fraction = half & 0x3ffU;
  if (exponent == 0) {
    const float value = std::ldexp(static_cast<float>(fraction), -24);
    return sign != 0 ? -value : value;
  }
  const std::uint32_t wide = exponent == 31 ? 0xffU : static_cast<std::uint32_t>(exponent - 15 + 127);
  return std::bit_cast<float>(sign | wide << 23 | fraction << 13);
}

/// The index of the first NaN or infinity in `values`; their number where all are finite.
inline std::size_t find_non_finite(std::span<const float> values) {
  static_assert(std::numeric_limits<float>::is_iec559);
  constexpr std::uint32_t kExponent = 0x7f800000;
  // The common case without a branch per value, so that it vectorizes.
  std::uint32_t any = 0;
  for (const float value : values)
    any |= (std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent ? 1U : 0U;
  if (any == 0) return values.size();
  std::size_t index = 0;
  while ((std::bit_cast<std::uint32_t>(values[index]) & kExponent) != kExponent) ++index;
  return index;
}

}  // namespace tvg::cli
