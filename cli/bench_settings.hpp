#pragma once
#include "codecs/other_codecs.hpp"
#include "tool/option_values.hpp"

#include <string>
#include <vector>

#include <tvg/types.hpp>

namespace tvg::cli {

/// Every bit pair of a list: "7..13", "7,9,11", "13:11,9", "9:7..13:11" (both ends with the same difference).
/// In the order they are named, none twice. Throws ToolError (kUsage).
std::vector<BitPair> parse_bit_list(const std::string& text);

/// "elp,basis,lossless": modes in the order they are named. Throws ToolError (kUsage).
std::vector<Mode> parse_mode_list(const std::string& text);

/// A mode as options and reports have it.
std::string name_of(Mode mode);

/// What is measured beside each other.
struct BenchCodecs {
  bool tvg = false;
  std::vector<bench::OtherCodec> others;
  std::vector<std::string> missing;  ///< what would be here, had it been built in
};

/// "tvg,draco,meshopt". Throws ToolError (kUsage), also for what this build was made without.
BenchCodecs parse_codec_list(const std::string& text);

/// What is measured where --codecs does not say: TVG, and Draco and meshoptimizer as far as they are built
/// in.
BenchCodecs usual_codecs();

/// The names that --codecs takes: "tvg, draco, meshopt, ...".
std::string codec_names();

}  // namespace tvg::cli
