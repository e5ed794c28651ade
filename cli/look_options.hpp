#pragma once
#include "cli/measure_options.hpp"
#include "player/overlay/overlay_values.hpp"
#include "player/view/look.hpp"

#include <string>

namespace CLI {
class App;
}

namespace tvg::cli {

/// The measure that `--overlay cost` shows: values of the options as typed.
struct ShownMeasureArguments {
  CostArguments cost;
  std::string skeleton;

  /// Whether any option was given.
  bool any() const { return cost.any() || !skeleton.empty(); }
};

/// Declares --size, --camera, --shading and the like; `arguments` must outlive the parsing.
void add_view_options(CLI::App& command, player::LookArguments& arguments);
/// These, --overlay and --ref, and what the overlay's measure is.
void add_look_options(CLI::App& command, player::LookArguments& arguments, ShownMeasureArguments& measure);

/// What the options mean; reads the files that they name, the skeleton only for a .tvg (`of_stream`): other
/// inputs bring their joints along. Throws ToolError: kUsage, and as importance_of() and read_stream_joints()
/// do.
player::ShownMeasure shown_measure(const ShownMeasureArguments& arguments, bool of_stream);

}  // namespace tvg::cli
