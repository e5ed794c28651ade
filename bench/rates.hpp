#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <tvg/encoder.hpp>
#include <tvg/metrics.hpp>

namespace tvg::bench {

/// A way of encoding and its name in tables and plots.
struct RateSetting {
  std::string name;
  EncodeOptions options;
};

/// Seconds of one thread's decoding, from bytes to float32.
struct DecodeTimes {
  double mesh = 0;    ///< connectivity, order, reference shape and what is prepared of them: once per mesh
  double planes = 0;  ///< the plans of mode basis
  double frames = 0;  ///< all else

  double all() const { return mesh + planes + frames; }
};

struct RateResult {
  std::uint64_t bytes = 0;    ///< of the whole file
  double encode_seconds = 0;  ///< of one run, the mesh's preparation included
  DecodeTimes decode;         ///< the fastest of three runs
  ComparisonReport errors;
  double lattice_rms = 0;  ///< of rounding to the lattice of B2 bits: step / sqrt(12); 0 for mode lossless
};

/// The options that the tables and plots vary; all else is the encoder's default.
RateSetting elp_setting(Predictor predictor, std::uint32_t gop_frames, int bits);
RateSetting basis_setting(std::uint32_t period_frames, std::uint32_t gop_frames, int bits);
RateSetting lossless_setting(std::uint32_t gop_frames);

/// Encodes and decodes in memory, one thread.
RateResult run_rate(const Sequence& sequence, const EncodeOptions& options);

}  // namespace tvg::bench
