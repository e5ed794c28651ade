#pragma once
#include "planes/lanes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#if defined(__SSE2__) && !defined(TVG_PLAIN_LANES)
#include <cstring>
#include <emmintrin.h>
#endif

namespace tvg {

/// One small integer for each plane of a group of four planes.
using ShortQuad = std::array<std::int16_t, 4>;

/// The sum of `count` entries of a table, each times its weight. It must not leave 32 bits.
inline Quad weighted_sum(const ShortQuad* table, const std::uint32_t* entries, const std::int16_t* weights,
                         std::size_t count) {
#if defined(__SSE2__) && !defined(TVG_PLAIN_LANES)
  // Two entries at a time: products of neighbouring numbers are added at once.
  const auto load = [table](std::uint32_t entry) {
    return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(table[entry].data()));
  };
  __m128i sum = _mm_setzero_si128();
  std::size_t i = 0;
  for (; i + 2 <= count; i += 2) {
    std::int32_t pair;
    std::memcpy(&pair, weights + i, sizeof pair);
    sum = _mm_add_epi32(sum, _mm_madd_epi16(_mm_unpacklo_epi16(load(entries[i]), load(entries[i + 1])),
                                            _mm_set1_epi32(pair)));
  }
  if (i < count) {
    const __m128i weight = _mm_set1_epi32(static_cast<std::uint16_t>(weights[i]));
    sum =
        _mm_add_epi32(sum, _mm_madd_epi16(_mm_unpacklo_epi16(load(entries[i]), _mm_setzero_si128()), weight));
  }
  Quad result;
  _mm_storeu_si128(reinterpret_cast<__m128i*>(result.data()), sum);
  return result;
#else
  Quad sum{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += weights[i] * table[entries[i]][j];
  }
  return sum;
#endif
}

}  // namespace tvg
