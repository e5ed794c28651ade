#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tvg/types.hpp>

namespace tvg::bench {

/// A sequence on an integer lattice: what every codec of the comparison is given, so that all have the same
/// error.
struct LatticeSequence {
  Mesh mesh;
  int bits = 0;                                    ///< 1 to 16: every value is below 2^bits
  std::vector<std::vector<std::uint16_t>> frames;  ///< [frame][vertex][xyz]

  /// Vertices of all frames together: the unit of "million vertices per second".
  double vertices() const {
    return static_cast<double>(mesh.vertex_count) * static_cast<double>(frames.size());
  }
};

/// One codec on one sequence, one thread; times as best_time() takes them.
struct CodecResult {
  std::string name;
  std::size_t bytes = 0;  ///< everything a decoder needs; connectivity once, with Draco in each frame
  double encode_seconds = 0;
  double decode_seconds = 0;
  bool exact =
      false;  ///< the decoder gave back the lattice (for Draco: as a set, since it reorders vertices)
};

/// Draco's edgebreaker at compression level 10 (speed 0), each frame a mesh of its own with integer
/// positions. Vertex order and correspondence between frames are lost.
CodecResult run_draco(const LatticeSequence& sequence);

/// meshoptimizer's vertex codec on frame deltas (four int16 each, one of them padding), vertices in the order
/// its strip and vertex fetch optimizers give, connectivity in its index codec. The original vertex order is
/// lost.
CodecResult run_meshoptimizer(const LatticeSequence& sequence);

/// The same, its bytes compressed again by zstd at level 19.
CodecResult run_meshoptimizer_zstd(const LatticeSequence& sequence);

/// zstd at level 19 on zigzag int16 frame deltas, planes of low and of high bytes per coordinate and frame;
/// vertex order is kept.
CodecResult run_zstd_deltas(const LatticeSequence& sequence);

}  // namespace tvg::bench
