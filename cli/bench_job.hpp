#pragma once
#include "cli/bench_inputs.hpp"
#include "cli/bench_settings.hpp"
#include "cli/encode_options.hpp"
#include "tool/progress.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tvg/metrics.hpp>

namespace tvg::cli {

/// Values of the options as typed; of those of encoding, --bits and --mode are lists.
struct BenchArguments : EncodeArguments {
  std::string modes = "elp,basis";
  std::string codecs;                      ///< empty: usual_codecs()
  std::optional<std::uint32_t> hausdorff;  ///< every so many frames; 0 for none, absent for few frames
  int runs = bench::kUsualRuns;
  std::string csv;
  std::string plot;
  bool json = false;
};

/// What is asked for, parsed.
struct BenchPlan {
  std::vector<BitPair> bits;
  std::vector<Mode> modes;
  BenchCodecs codecs;
};

/// One codec on one animation. Times are seconds of processor time, of all threads together.
struct BenchRow {
  std::string codec;            ///< "tvg", "draco"
  std::string mode;             ///< of tvg; else empty
  std::optional<BitPair> bits;  ///< none in mode lossless
  std::uint64_t bytes = 0;
  ComparisonReport errors;
  double encode_seconds = 0;
  double decode_seconds = 0;

  /// "tvg basis", "draco".
  std::string title() const { return mode.empty() ? codec : codec + " " + mode; }
};

/// All rows of one animation.
struct BenchedAnimation {
  BenchInput input;
  std::uint64_t vertices = 0, faces = 0, frames = 0;
  double diagonal = 0;
  std::uint32_t hausdorff_stride = 0;  ///< 0: not measured
  std::vector<BenchRow> rows;          ///< by codec and mode, then by bits
};

/// What the options mean, as far as that can be told before a file is opened. Throws ToolError (kUsage).
BenchPlan plan_bench(const BenchArguments& arguments);

/// Encodes and decodes an animation in memory, once for every row. Notes go to standard error unless it is to
/// be quiet. Throws ToolError.
BenchedAnimation bench_animation(const BenchArguments& arguments, const BenchPlan& plan,
                                 const BenchInput& input);

}  // namespace tvg::cli
