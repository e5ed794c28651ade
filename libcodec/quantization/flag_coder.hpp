#pragma once
#include "base/byte_io.hpp"
#include "base/stream_error.hpp"
#include "connectivity/connectivity.hpp"
#include "entropy/adaptive_models.hpp"
#include "entropy/range_coder.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace tvg {

/// Codes the importance flags of a GOP along the traversal (format-spec §7.4): one adaptive bit per vertex,
/// its model chosen by how many of the gate's three vertices are flagged. `flags` ([traversal index], 0 or 1)
/// is read when encoding and filled when decoding.
template <class Coder>
void code_flags(Coder& coder, std::span<const Gate> gates, std::span<std::uint8_t> flags) {
  std::array<AdaptiveBit, 5> models;  // 0 to 3 flagged; 4: no whole gate
  for (std::size_t v = 0; v < gates.size(); ++v) {
    const Gate& gate = gates[v];
    const std::size_t context =
        gate.o == kNoVertex ? 4 : std::size_t{flags[gate.n]} + flags[gate.p] + flags[gate.o];
    flags[v] = coder.code(models[context], flags[v] != 0) ? 1 : 0;
  }
}

/// Decodes the flags that these bytes hold; `flags` has a place for each gate.
inline Fault decode_flags(Bytes bytes, std::span<const Gate> gates, std::span<std::uint8_t> flags) {
  RangeDecoder coder(bytes);
  code_flags(coder, gates, flags);
  if (!coder.finished()) return {"§6.1", "the importance flags do not fill their bytes exactly"};
  return {};
}

}  // namespace tvg
