#pragma once
#include "codecs/other_codecs.hpp"

#include <cstdint>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::bench {

/// What the comparison varies; everything else is the encoder's default, predictor elp.
struct TvgSettings {
  int fine_bits = 11;          ///< B2, of important vertices
  int coarse_bits = 11;        ///< B1, of the others
  double important_share = 1;  ///< share of important vertices, 0 to 1
  std::uint32_t gop_frames = 50;
};

struct TvgResult {
  CodecResult codec;  ///< `exact`: the decoder's digests of its integers fit those of the encoder
  std::vector<FramePositions> frames;  ///< decoded, [frame][vertex][xyz]
};

/// Encodes and decodes in memory through the public interface, one thread.
TvgResult run_tvg(const Sequence& sequence, const TvgSettings& settings);

}  // namespace tvg::bench
