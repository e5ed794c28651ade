#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace tvg {

/// The bytes of `value` as another type of its size: std::bit_cast, for which some standard libraries of
/// C++20 are too old.
template <class To, class From>
To bits_as(const From& value) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> &&
                std::is_trivially_copyable_v<From>);
  To result;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

/// Place of the highest bit that is set, 0 to 31; `value` is not zero.
inline std::uint32_t highest_bit(std::uint32_t value) {
#if defined(__GNUC__)  // which else looks whether it is zero first, where the processor wants to know
  return 31u ^ static_cast<std::uint32_t>(__builtin_clz(value));
#else
  return static_cast<std::uint32_t>(std::bit_width(value)) - 1;
#endif
}

}  // namespace tvg
