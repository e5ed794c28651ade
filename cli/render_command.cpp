#include "cli/commands.hpp"
#include "cli/look_options.hpp"
#include "cli/open_source_files.hpp"
#include "encoder/importers/scene_file.hpp"
#include "player/frames/shown_frames.hpp"
#include "player/render/render_job.hpp"
#include "player/render/render_options.hpp"
#include "tool/input_files.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include <tvg/levels.hpp>

namespace tvg::cli {

namespace {

struct RenderCommandArguments : player::RenderArguments {
  ShownMeasureArguments measure;
};

player::RenderOptions options_of(const RenderCommandArguments& arguments) {
  player::RenderOptions options = player::parse_render_arguments(arguments);
  if (arguments.measure.any() && options.overlay != player::Overlay::kCost) {
    throw ToolError(ExitStatus::kUsage,
                    "--measure and what goes with it: add --overlay cost, which shows the measure");
  }
  options.open_source = source_opener();
  options.open_inputs = source_opener(arguments.measure.skeleton);
  options.measure = shown_measure(arguments.measure, player::is_stream(options.inputs));
  return options;
}

InputFiles files_of(const player::RenderOptions& options, const ShownMeasureArguments& measure) {
  InputFiles inputs;
  inputs.add(with_scene_files(options.inputs));
  inputs.add(with_scene_files(options.reference));
  inputs.add(measure.cost.weights());
  inputs.add(measure.skeleton);
  return inputs;
}

}  // namespace

void add_render_command(CLI::App& tool) {
  auto arguments = std::make_shared<RenderCommandArguments>();
  CLI::App& command = *tool.add_subcommand("render", "Draw frames to pictures or a clip; needs no display");
  command
      .add_option("input", arguments->inputs,
                  "a .tvg (- for standard input), a mesh file and its cache, or a sequence of mesh files")
      ->required();
  command
      .add_option("-o,--output", arguments->output,
                  "pictures (out%04d.png, numbered as the frames are), one picture or, of several frames, a "
                  "contact sheet (out.png), or a clip (out.mp4, .webm, .mkv; by ffmpeg)")
      ->required();
  command.add_option("--frames", arguments->frames, "draw frames A-B, or A, only; counted from 0");
  command.add_option("--sheet", arguments->sheet, "columns and rows of a contact sheet: 4x3");
  command.add_option("--scale", arguments->scale, "value of the last colour of --overlay cost or error");
  command.add_flag("--side-by-side", arguments->side_by_side, "draw the reference at the left");
  add_look_options(command, *arguments, arguments->measure);
  command.add_flag("--no-labels", arguments->no_labels, "draw no text and no legend");
  command.add_option("--fps", arguments->fps, "frames per second of a clip: 30, 30000/1001");
  command
      .add_option("--lod", arguments->lod,
                  "draw the coarser mesh of this number that a .tvg has, 1 the first (default: 0, the whole)")
      ->check(CLI::Range(0u, kMaxCoarseMeshes));
  command.add_flag("--conceal", arguments->conceal,
                   "where frames are damaged, hold the last good one and go on");
  command.add_flag("-q,--quiet", arguments->quiet, "print errors only");
  command.callback([arguments] {
    const player::RenderOptions options = options_of(*arguments);
    files_of(options, arguments->measure).check_output(options.output);
    player::render(options);
  });
}

}  // namespace tvg::cli
