#include "cli/look_options.hpp"

#include "cli/input_options.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace tvg::cli {

void add_view_options(CLI::App& command, player::LookArguments& arguments) {
  command.add_option("--size", arguments.size, "width and height in pixels")->capture_default_str();
  command.add_option("--camera", arguments.camera,
                     "front, back, left, right, top, bottom, iso, or azimuth,elevation[,zoom] in degrees "
                     "(default 30,15)");
  command.add_option("--up", arguments.up,
                     "the axis that is up: +X, -X, +Y, -Y, +Z or -Z (default: as the input's metadata say, "
                     "else +Y)");
  command.add_option("--front", arguments.front,
                     "the axis that looks at who sees the front, likewise (default: +Z where y is up, -Y "
                     "where z is)");
  command.add_flag("--axes", arguments.axes, "show in a corner which way x, y and z go");
  command.add_option("--shading", arguments.shading,
                     "smooth or flat (default: as the input's metadata say, else smooth)");
  command.add_flag("--plain", arguments.plain,
                   "draw in one colour, whatever colours, materials and textures the input has");
  command.add_flag("--wireframe", arguments.wireframe, "draw edges over the surface");
  command.add_flag("--grid", arguments.grid, "draw the ground");
  command.add_option("--background", arguments.background, "light (default), dark, white or #rrggbb");
}

void add_look_options(CLI::App& command, player::LookArguments& arguments, ShownMeasureArguments& measure) {
  command
      .add_option(
          "--overlay", arguments.overlay,
          "colour by importance (flags of a .tvg), cost (over each GOP: of curv, or of what --measure "
          "says, whatever the stream was marked by) or error (distance to --ref)")
      ->capture_default_str();
  command.add_option("--ref", arguments.reference,
                     "the reference: a .tvg, a mesh file and its cache, or a sequence of mesh files");
  add_cost_options(command, measure.cost);
  add_skeleton_option(command, measure.skeleton);
  add_view_options(command, arguments);
}

player::ShownMeasure shown_measure(const ShownMeasureArguments& arguments, bool of_stream) {
  player::ShownMeasure measure{importance_of(arguments.cost), words_for(arguments.cost)};
  if (!of_stream) return measure;
  if (!arguments.skeleton.empty()) {
    measure.joints = std::make_shared<const JointTracks>(read_stream_joints(arguments.skeleton));
  } else if (uses_skeleton(measure.importance)) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("--measure {}: a .tvg has no skeleton: name the file of one with --skeleton",
                                arguments.cost.criteria));
  }
  return measure;
}

}  // namespace tvg::cli
