#pragma once
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

}  // namespace tvg
