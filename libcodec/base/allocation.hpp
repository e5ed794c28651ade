#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

// Memory that may not be there, without exceptions: the decoder asks before it takes. What a standard
// container would then fail to get although it was there a moment ago ends the program, as everywhere where
// exceptions are off.
namespace tvg {

/// Whether this many bytes can be had at once, beside what is held.
bool can_allocate(std::size_t bytes) noexcept;

/// What the few short strings and nodes around a structure take at most: asked for before it is read.
inline constexpr std::size_t kSmallThings = 4096;

/// Makes room for `count` elements. False, and no change, where there is no memory for them.
template <class T>
[[nodiscard]] bool try_reserve(std::vector<T>& vector, std::size_t count) {
  if (count <= vector.capacity()) return true;
  constexpr std::size_t kSize = sizeof(T);  // NOLINT(bugprone-sizeof-expression): elements may be pointers
  if (count > static_cast<std::size_t>(-1) / 2 / kSize || !can_allocate(count * kSize)) return false;
  vector.reserve(count);
  return true;
}

/// Makes room for `more` further elements, growing as push_back() does.
template <class T>
[[nodiscard]] bool try_grow(std::vector<T>& vector, std::size_t more) {
  if (more <= vector.capacity() - vector.size()) return true;
  if (more > static_cast<std::size_t>(-1) / 4) return false;
  const std::size_t needed = vector.size() + more;
  return try_reserve(vector, std::max(needed, 2 * vector.capacity())) || try_reserve(vector, needed);
}

/// Makes the vector `count` elements long; new ones are zero.
template <class T>
[[nodiscard]] bool try_resize(std::vector<T>& vector, std::size_t count) {
  if (!try_reserve(vector, count)) return false;
  vector.resize(count);
  return true;
}

/// Appends an element.
template <class T>
[[nodiscard]] bool try_push_back(std::vector<T>& vector, T value) {
  if (!try_grow(vector, 1)) return false;
  vector.push_back(std::move(value));
  return true;
}

}  // namespace tvg
