#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// The coder of planes once more, as it is compiled where there are no vectors, under another name.
#define TVG_PLAIN_LANES
#define tvg tvg_plain
#include "coefficient_trace.hpp"
#include "plane_trace.hpp"
// What of the range coder is compiled once.
#include "entropy/range_coder_encode.cpp"
#undef tvg

namespace tvg::test {

std::vector<std::int32_t> trace_plain_lanes(std::uint32_t seed) {
  return tvg_plain::test::trace_lanes(seed);
}

std::vector<std::vector<std::uint8_t>> trace_plain_planes(std::uint32_t seed) {
  return tvg_plain::test::trace_planes(seed);
}

std::vector<std::vector<std::uint8_t>> trace_plain_coefficients(std::uint32_t seed) {
  return tvg_plain::test::trace_coefficients(seed);
}

}  // namespace tvg::test
