#pragma once
#include "base/checksum.hpp"
#include "modes/position_digest.hpp"
#include "planes/reals.hpp"
#include "quantization/number_line.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

// What encoder and decoder of a GOP in mode lossless share (format-spec §7.9).
namespace tvg {

/// Adds a frame to the digest of positions: the bits of its coordinates, ordered().
inline void add_to_digest(Hasher& digest, std::span<const Reals> values) {
  add_positions_to_digest(digest, values.size(), [values](std::size_t v, std::size_t axis) {
    return ordered(float_of_value(values[v][axis]));
  });
}

}  // namespace tvg
