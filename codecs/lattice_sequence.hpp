#pragma once
#include <cstdint>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::bench {

using LatticeFrames = std::vector<std::vector<std::uint16_t>>;  ///< [frame][vertex][xyz]

/// A sequence on an integer lattice: what every codec of the comparison is given, so that all have the same
/// error.
struct LatticeSequence {
  Mesh mesh;
  int bits = 0;          ///< 1 to 16: every value is below 2^bits
  LatticeFrames frames;  ///< [frame][vertex][xyz]

  /// Vertices of all frames together: the unit of "million vertices per second".
  double vertices() const {
    return static_cast<double>(mesh.vertex_count) * static_cast<double>(frames.size());
  }
  /// As many frames, all zero.
  LatticeFrames blank_frames() const {
    return LatticeFrames(frames.size(), std::vector<std::uint16_t>(3 * std::size_t{mesh.vertex_count}));
  }
};

constexpr int kMostLatticeBits = 16;

/// The lattice of the format: index = floor((x - minimum) / step), step = largest extent / 2^bits over all
/// frames.
struct Lattice {
  LatticeSequence indices;
  double minimum[3] = {};
  double step = 0;

  /// Every index as the centre of its cell, [frame][vertex][xyz].
  std::vector<FramePositions> centres() const;
};

/// `bits`: 1 to kMostLatticeBits.
Lattice quantize(const Sequence& sequence, int bits);

}  // namespace tvg::bench
