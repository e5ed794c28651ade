#include "cli/look_options.hpp"

#include <CLI/CLI.hpp>

namespace tvg::cli {

void add_view_options(CLI::App& command, LookArguments& arguments) {
  command.add_option("--size", arguments.size, "width and height in pixels")->capture_default_str();
  command.add_option("--camera", arguments.camera,
                     "front, back, left, right, top, bottom, iso, or azimuth,elevation[,zoom] in degrees "
                     "(default 30,15)");
  command.add_option("--shading", arguments.shading, "smooth or flat")->capture_default_str();
  command.add_flag("--wireframe", arguments.wireframe, "draw edges over the surface");
  command.add_flag("--grid", arguments.grid, "draw the ground");
  command.add_option("--background", arguments.background, "light (default), dark, white or #rrggbb");
}

void add_look_options(CLI::App& command, LookArguments& arguments) {
  command
      .add_option(
          "--overlay", arguments.overlay,
          "colour by importance (flags of a .tvg), cost (of curv, the default measure, over each GOP, "
          "whatever the stream was marked by) or error (distance to --ref)")
      ->capture_default_str();
  command.add_option("--ref", arguments.reference,
                     "the reference: a .tvg, a mesh file and its cache, or a sequence of mesh files");
  add_view_options(command, arguments);
}

}  // namespace tvg::cli
