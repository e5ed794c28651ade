#pragma once
#include "cli/input_options.hpp"
#include "cli/level_options.hpp"
#include "cli/measure_options.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tvg/encoder.hpp>

namespace CLI {
class App;
}

// How an animation is encoded, for every command that makes streams of what users have.
namespace tvg::cli {

/// Values of the options as typed; a command changes what it has other defaults for before it declares them.
struct EncodeArguments : InputArguments {
  std::string bits = "11";
  std::string step;
  MeasureArguments measure;
  LevelArguments levels;
  std::string predictor = "elp";
  std::string mode = "elp";
  bool lossless = false;
  std::optional<std::uint32_t> gop;
  std::string period;
  std::string max_error;
  int effort = 5;
  unsigned threads = 0;
  bool reorder = false;
  bool keep_order = false;
  std::uint32_t max_vertices = 0;
  std::uint32_t max_faces = 0;
  std::uint32_t max_meshes = 1;
  bool live = false;  ///< of `tvg encode` alone
  bool quiet = false;
  std::string name;
  std::string units;
  std::string up;
  std::vector<std::string> metadata;
};

/// Declares the inputs and all that is to be said of encoding them, --threads and --quiet among it; not where
/// the stream goes. `arguments` must outlive the parsing. `others`: what the command takes beside these
/// inputs.
void add_encode_options(CLI::App& command, EncodeArguments& arguments, const std::string& others = "");

/// Declares what a mode leaves to choose: --period and --predictor.
void add_mode_options(CLI::App& command, EncodeArguments& arguments);

/// Declares --effort and --gop.
void add_effort_options(CLI::App& command, EncodeArguments& arguments);

/// What the options mean; reads the file of --weights. Throws ToolError (kUsage) that shows what would be
/// right.
EncodeOptions encode_options(const EncodeArguments& arguments);

}  // namespace tvg::cli
