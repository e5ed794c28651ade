#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

// The models once more, as they are compiled where there is no SSE2, under another name.
#undef __SSE2__
#define tvg tvg_portable
#include "model_trace.hpp"
#undef tvg

namespace tvg {

std::vector<std::uint32_t> trace_portable_models(std::uint32_t seed) {
  return tvg_portable::trace_models(seed);
}

}  // namespace tvg
