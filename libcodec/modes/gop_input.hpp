#pragma once
#include "basis/basis_fit_encode.hpp"
#include "quantization/lattice.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// How a period is encoded in mode basis.
struct BasisInput {
  std::uint32_t gop_frames = 32;  ///< of the GOPs that the period is cut into
  /// In steps of the lattice: what no coordinate may be off by more. Absent: the error is that of rounding to
  /// the lattice, on average.
  std::optional<double> largest_error;
  FitEffort effort;
};

/// The values of animated attributes in one frame, [animated attribute], as those were given.
using FrameValues = std::vector<std::vector<float>>;

/// Frames to be encoded together: a GOP, or in mode basis a period.
struct GopInput {
  std::span<const FramePositions> frames;  ///< [frame][vertex][xyz], in the order of the input mesh
  /// [frame][animated attribute][value][component]; not looked at where the mesh has no such attributes.
  std::span<const FrameValues> values;
  Mode mode = Mode::kElp;
  std::uint64_t first_frame = 0;  ///< number of its first frame in the sequence it comes from
  Lattice lattice;
  std::vector<std::uint8_t> flags;  ///< [vertex]: 1 important; not looked at unless the lattice is hybrid
  Predictor predictor = Predictor::kElp;
  BasisInput basis;  ///< of mode basis
};

}  // namespace tvg
