#pragma once
#include "quantization/lattice.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// One GOP to be encoded.
struct GopInput {
  std::span<const FramePositions> frames;  ///< [frame][vertex][xyz], in the order of the input mesh
  std::uint64_t first_frame = 0;           ///< number of its first frame in the sequence it comes from
  Lattice lattice;
  std::vector<std::uint8_t> flags;  ///< [vertex]: 1 important; not looked at unless the lattice is hybrid
  Predictor predictor = Predictor::kElp;
};

}  // namespace tvg
