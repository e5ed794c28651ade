#include "basis/pair_sums.hpp"

#include <bit>
#include <cstddef>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(TVG_PLAIN_LANES)
#define TVG_HAS_AVX2_DISPATCH
#endif
#ifdef TVG_HAS_AVX2_DISPATCH
#include <immintrin.h>
#elif defined(__SSE2__) && !defined(TVG_PLAIN_LANES)
#include <emmintrin.h>
#endif

namespace tvg {

namespace {

#if defined(__SSE2__) && !defined(TVG_PLAIN_LANES)

/// Sums of products of eight vertices: [half of the block][axis].
struct Accumulator {
  __m128i halves[2][3] = {};

  void add(const CoefficientPlanes::PairBlock& pairs, const RowPair& rows) {
    const __m128i all = _mm_loadu_si128(reinterpret_cast<const __m128i*>(rows.data()));
    const __m128i row[3] = {_mm_shuffle_epi32(all, 0x00), _mm_shuffle_epi32(all, 0x55),
                            _mm_shuffle_epi32(all, 0xAA)};
    for (std::size_t half = 0; half < 2; ++half) {
      const __m128i values = _mm_loadu_si128(reinterpret_cast<const __m128i*>(pairs.data() + 4 * half));
      for (std::size_t axis = 0; axis < 3; ++axis)
        halves[half][axis] = _mm_add_epi32(halves[half][axis], _mm_madd_epi16(values, row[axis]));
    }
  }

  void store(PairSums& sums) const {
    for (std::size_t half = 0; half < 2; ++half) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        _mm_storeu_si128(reinterpret_cast<__m128i*>(sums[axis].data() + 4 * half), halves[half][axis]);
    }
  }
};

#else

struct Accumulator {
  PairSums sums_{};

  void add(const CoefficientPlanes::PairBlock& pairs, const RowPair& rows) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < CoefficientPlanes::kAtOnce; ++i)
        sums_[axis][i] += pairs[i][0] * rows[axis][0] + pairs[i][1] * rows[axis][1];
    }
  }

  void store(PairSums& sums) const { sums = sums_; }
};

#endif

}  // namespace

void add_pairs_plainly(const CoefficientPlanes::PairBlock* pairs, std::span<const RowPair> high,
                       std::span<const LowPair> low, PairSums& upper, PairSums& lower) {
  Accumulator high_sums, low_sums;
  for (std::size_t pair = 0; pair < high.size(); ++pair) high_sums.add(pairs[pair], high[pair]);
  for (const LowPair& part : low) low_sums.add(pairs[part.pair], part.rows);
  high_sums.store(upper);
  low_sums.store(lower);
}

#ifdef TVG_HAS_AVX2_DISPATCH

namespace {

/// Sums of products of eight vertices: [axis].
using WideSums = __m256i[3];

[[gnu::target("avx2"), gnu::always_inline]] inline void add_widely(const CoefficientPlanes::PairBlock& pairs,
                                                                   const RowPair& rows, WideSums& sums) {
  const __m256i values = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(pairs.data()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const __m256i row = _mm256_set1_epi32(std::bit_cast<std::int32_t>(rows[axis]));
    sums[axis] = _mm256_add_epi32(sums[axis], _mm256_madd_epi16(values, row));
  }
}

[[gnu::target("avx2"), gnu::always_inline]] inline void store_widely(const WideSums& sums, PairSums& to) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to[axis].data()), sums[axis]);
}

[[gnu::target("avx2")]] void add_pairs_widely(const CoefficientPlanes::PairBlock* pairs,
                                              std::span<const RowPair> high, std::span<const LowPair> low,
                                              PairSums& upper, PairSums& lower) {
  WideSums high_sums = {}, low_sums = {};
  for (std::size_t pair = 0; pair < high.size(); ++pair) add_widely(pairs[pair], high[pair], high_sums);
  for (const LowPair& part : low) add_widely(pairs[part.pair], part.rows, low_sums);
  store_widely(high_sums, upper);
  store_widely(low_sums, lower);
}

}  // namespace

#endif

void add_pairs(const CoefficientPlanes::PairBlock* pairs, std::span<const RowPair> high,
               std::span<const LowPair> low, PairSums& upper, PairSums& lower) {
#ifdef TVG_HAS_AVX2_DISPATCH
  static const bool wide = __builtin_cpu_supports("avx2") != 0;
  if (wide) return add_pairs_widely(pairs, high, low, upper, lower);
#endif
  add_pairs_plainly(pairs, high, low, upper, lower);
}

}  // namespace tvg
