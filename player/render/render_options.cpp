#include "player/render/render_options.hpp"

#include "player/render/video_writer.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tvg::player {

namespace {

constexpr int kMostCells = 32;
constexpr double kMostScale = 1e30;  // float32 holds it

void set_output(RenderOptions& options, const std::string& output) {
  options.output = output;
  if (is_video_name(output)) {
    options.kind = RenderOptions::Output::kVideo;
  } else if (!cli::has_suffix(output, ".png") && output != "-") {
    cli::fail_option("-o", output,
                     "write a picture (.png), pictures (out%04d.png) or a clip (.mp4, .webm, .mkv)");
  } else if ((options.pattern = cli::parse_frame_pattern(output))) {
    options.kind = RenderOptions::Output::kFrames;
  }
}

void check_together(const RenderOptions& options, const RenderArguments& arguments) {
  const bool video = options.kind == RenderOptions::Output::kVideo;
  if (video && (options.width % 2 != 0 || options.height % 2 != 0)) {
    cli::fail_option("--size", arguments.size, "a clip needs even numbers");
  }
  if (options.sheet && options.kind != RenderOptions::Output::kPicture) {
    cli::fail_option("--sheet", arguments.sheet,
                     "a contact sheet is one picture: write it to a .png without a frame's number");
  }
  if (options.sheet &&
      (options.width / options.sheet->columns < 16 || options.height / options.sheet->rows < 16)) {
    cli::fail_option("--sheet", arguments.sheet,
                     "the pictures would be under 16 pixels: give a larger --size");
  }
  if (options.fps && !video) cli::fail_option("--fps", arguments.fps, "only a clip has frames per second");
  if (options.side_by_side && options.reference.empty()) {
    throw cli::ToolError(cli::ExitStatus::kUsage, "--side-by-side: name the reference with --ref");
  }
  if (!options.reference.empty() && !options.side_by_side && options.overlay != Overlay::kError) {
    throw cli::ToolError(cli::ExitStatus::kUsage, "--ref: add --overlay error or --side-by-side to show it");
  }
  if (options.lod > 0 && !options.reference.empty()) {
    throw cli::ToolError(
        cli::ExitStatus::kUsage,
        "--lod: a reference has all vertices and a coarser mesh some of them; leave out --ref");
  }
  if (options.largest && options.overlay != Overlay::kCost && options.overlay != Overlay::kError) {
    cli::fail_option("--scale", arguments.scale, "only --overlay cost and error have a scale");
  }
}

}  // namespace

RenderOptions parse_render_arguments(const RenderArguments& arguments) {
  RenderOptions options;
  static_cast<Look&>(options) = parse_look(arguments);
  options.inputs = arguments.inputs;
  set_output(options, arguments.output);
  if (!arguments.frames.empty()) options.frames = cli::parse_frame_range(arguments.frames);
  if (!arguments.scale.empty())
    options.largest = cli::parse_number("--scale", arguments.scale, {0, kMostScale, true});
  if (!arguments.sheet.empty()) {
    const auto shape = cli::parse_count_pair(arguments.sheet, kMostCells);
    if (!shape)
      cli::fail_option("--sheet", arguments.sheet,
                       fmt::format("write columns and rows, 1 to {}, as 4x3", kMostCells));
    options.sheet = {shape->first, shape->second};
  }
  if (!arguments.fps.empty()) {
    static_cast<void>(cli::parse_rate(arguments.fps));
    options.fps = arguments.fps;
  }
  options.side_by_side = arguments.side_by_side;
  options.labels = !arguments.no_labels;
  options.conceal = arguments.conceal;
  options.quiet = arguments.quiet;
  options.lod = arguments.lod;
  check_together(options, arguments);
  return options;
}

}  // namespace tvg::player
