#pragma once
#include <cstdio>

namespace tvg::fuzz {

/// Ends the run at a broken promise, and says which. (clang 14 has no std::source_location.)
inline void require(bool condition, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  if (condition) return;
  std::fprintf(stderr, "%s:%d: a promise is broken\n", file, line);
  __builtin_trap();
}

}  // namespace tvg::fuzz
