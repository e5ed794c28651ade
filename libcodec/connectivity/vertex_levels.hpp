#pragma once
#include "base/byte_io.hpp"
#include "base/stream_error.hpp"
#include "connectivity/connectivity.hpp"
#include "entropy/adaptive_models.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/levels.hpp>

namespace tvg {

/// Codes the levels of vertices along the traversal (format-spec §5.5): whether a vertex is of the highest
/// level, of the next lower one and so on, with models chosen by the levels of its gate, next to which its
/// own is rare. `levels` ([traversal index], below `count`) is read when encoding and filled when decoding.
/// Returns false when the bytes are used up long before the end.
template <class Coder>
bool code_levels(Coder& coder, std::span<const Gate> gates, std::uint32_t count,
                 std::span<std::uint8_t> levels) {
  constexpr std::size_t kDistances = 12;  // from the highest level
  std::array<std::array<std::array<AdaptiveBit, 3>, 4>, kDistances> models;
  const auto above = [levels](std::uint32_t v, std::uint32_t level) {
    return v != kNoVertex && levels[v] > level ? std::size_t{1} : std::size_t{0};
  };
  const auto at = [levels](std::uint32_t v, std::uint32_t level) {
    return v != kNoVertex && levels[v] == level;
  };
  for (std::size_t v = 0; v < gates.size(); ++v) {
    const Gate& gate = gates[v];
    std::uint32_t level = count - 1;
    for (; level > 0; --level) {
      const std::size_t beside =
          at(gate.n, level) || at(gate.p, level) ? 3 : above(gate.n, level) + above(gate.p, level);
      const std::size_t across = at(gate.o, level) ? 2 : above(gate.o, level);
      AdaptiveBit& model = models[std::min<std::size_t>(count - 1 - level, kDistances - 1)][beside][across];
      if (coder.code(model, levels[v] == level)) break;
    }
    levels[v] = static_cast<std::uint8_t>(level);
    if constexpr (Coder::kDecoding) {
      if (v % 256 == 255 && coder.overrun()) return false;
    }
  }
  return true;
}

/// Decodes the levels of vertices from all of a section into `levels`, [traversal index]. kMalformed,
/// kOutOfMemory.
Fault decode_levels(Bytes section, std::span<const Gate> gates, std::vector<std::uint8_t>& levels);

}  // namespace tvg
