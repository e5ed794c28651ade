#pragma once
#include "base/checksum.hpp"
#include "planes/reals.hpp"
#include "quantization/number_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

// What encoder and decoder of a GOP in mode lossless share (format-spec §7.9).
namespace tvg {

/// Adds a frame to the digest of positions (§7.6): x, y and z of each vertex, [traversal index].
inline void add_to_digest(Hasher& digest, std::span<const Reals> values) {
  constexpr std::size_t kAtOnce = 256;
  std::array<std::int32_t, 3 * kAtOnce> numbers;
  while (!values.empty()) {
    const std::size_t count = std::min(kAtOnce, values.size());
    for (std::size_t i = 0; i < 3 * count; ++i) numbers[i] = ordered(float_of_value(values[i / 3][i % 3]));
    digest.update(std::span<const std::int32_t>(numbers).first(3 * count));
    values = values.subspan(count);
  }
}

}  // namespace tvg
