#pragma once
#include <cstdio>
#include <source_location>

namespace tvg::fuzz {

/// Ends the run at a broken promise, and says which.
inline void require(bool condition, std::source_location place = std::source_location::current()) {
  if (condition) return;
  std::fprintf(stderr, "%s:%u: a promise is broken\n", place.file_name(), unsigned{place.line()});
  __builtin_trap();
}

}  // namespace tvg::fuzz
