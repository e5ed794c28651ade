#pragma once
#include "codecs/lattice_sequence.hpp"
#include "codecs/timing.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace tvg::bench {

/// One codec on one sequence, one thread; times as best_time() takes them.
struct CodecResult {
  std::string name;
  std::size_t bytes = 0;  ///< everything a decoder needs; connectivity once, with Draco in each frame
  double encode_seconds = 0;
  double decode_seconds = 0;
  bool exact =
      false;  ///< the decoder gave back the lattice (for Draco: as a set, since it reorders vertices)
};

#ifdef TVG_HAS_DRACO
/// Draco's edgebreaker at compression level 10 (speed 0), each frame a mesh of its own with integer
/// positions. Vertex order and correspondence between frames are lost.
CodecResult run_draco(const LatticeSequence& sequence, int runs = kUsualRuns);
#endif

/// meshoptimizer's vertex codec on frame deltas (four int16 each, one of them padding), vertices in the order
/// its strip and vertex fetch optimizers give, connectivity in its index codec. The original vertex order is
/// lost.
CodecResult run_meshoptimizer(const LatticeSequence& sequence, int runs = kUsualRuns);

/// The same, its bytes compressed again by zstd at level 19.
CodecResult run_meshoptimizer_zstd(const LatticeSequence& sequence, int runs = kUsualRuns);

/// zstd at level 19 on zigzag int16 frame deltas, planes of low and of high bytes per coordinate and frame;
/// vertex order is kept.
CodecResult run_zstd_deltas(const LatticeSequence& sequence, int runs = kUsualRuns);

/// A codec by the name that options have for it.
struct OtherCodec {
  std::string_view name;  ///< "draco"
  CodecResult (*run)(const LatticeSequence& sequence,
                     int runs);  ///< null where it was left out of this build
};

/// Every codec above.
std::span<const OtherCodec> other_codecs();

}  // namespace tvg::bench
