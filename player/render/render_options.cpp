#include "player/render/render_options.hpp"

#include "cli/mesh_format.hpp"
#include "cli/option_values.hpp"
#include "cli/tool_error.hpp"
#include "player/render/video_writer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace tvg::cli {

namespace {

constexpr int kMostCells = 32;

std::optional<double> parse_positive(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value) || !(value > 0)) return std::nullopt;
  return value;
}

void set_output(RenderOptions& options, const std::string& output) {
  options.output = output;
  if (is_video_name(output)) {
    options.kind = RenderOptions::Output::kVideo;
  } else if (!has_suffix(output, ".png") && output != "-") {
    fail_option("-o", output, "write a picture (.png), pictures (out%04d.png) or a clip (.mp4, .webm, .mkv)");
  } else if ((options.pattern = parse_frame_pattern(output))) {
    options.kind = RenderOptions::Output::kFrames;
  }
}

void check_together(const RenderOptions& options, const RenderArguments& arguments) {
  const bool video = options.kind == RenderOptions::Output::kVideo;
  if (video && (options.width % 2 != 0 || options.height % 2 != 0)) {
    fail_option("--size", arguments.size, "a clip needs even numbers");
  }
  if (options.sheet && options.kind != RenderOptions::Output::kPicture) {
    fail_option("--sheet", arguments.sheet,
                "a contact sheet is one picture: write it to a .png without a frame's number");
  }
  if (options.sheet &&
      (options.width / options.sheet->columns < 16 || options.height / options.sheet->rows < 16)) {
    fail_option("--sheet", arguments.sheet, "the pictures would be under 16 pixels: give a larger --size");
  }
  if (options.fps && !video) fail_option("--fps", arguments.fps, "only a clip has frames per second");
  if (options.side_by_side && options.reference.empty()) {
    throw ToolError(ExitStatus::kUsage, "--side-by-side: name the reference with --ref");
  }
  if (!options.reference.empty() && !options.side_by_side && options.overlay != Overlay::kError) {
    throw ToolError(ExitStatus::kUsage, "--ref: add --overlay error or --side-by-side to show it");
  }
  if (options.largest && options.overlay != Overlay::kCost && options.overlay != Overlay::kError) {
    fail_option("--scale", arguments.scale, "only --overlay cost and error have a scale");
  }
}

}  // namespace

bool is_frame_rate(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::optional<double> above = parse_positive(std::string_view(text).substr(0, slash));
  const std::optional<double> below =
      slash == std::string::npos ? 1.0 : parse_positive(std::string_view(text).substr(slash + 1));
  return above && below && *above / *below >= 0.01 && *above / *below <= 1000;
}

RenderOptions parse_render_arguments(const RenderArguments& arguments) {
  RenderOptions options;
  static_cast<Look&>(options) = parse_look(arguments);
  options.inputs = arguments.inputs;
  set_output(options, arguments.output);
  if (!arguments.frames.empty()) options.frames = parse_frame_range(arguments.frames);
  if (!arguments.scale.empty() && !(options.largest = parse_positive(arguments.scale))) {
    fail_option("--scale", arguments.scale, "write the value of the last colour, above 0");
  }
  if (!arguments.sheet.empty()) {
    const auto shape = parse_count_pair(arguments.sheet, kMostCells);
    if (!shape)
      fail_option("--sheet", arguments.sheet,
                  fmt::format("write columns and rows, 1 to {}, as 4x3", kMostCells));
    options.sheet = {shape->first, shape->second};
  }
  if (!arguments.fps.empty()) {
    if (!is_frame_rate(arguments.fps))
      fail_option("--fps", arguments.fps, "write frames per second as 30 or 30000/1001");
    options.fps = arguments.fps;
  }
  options.side_by_side = arguments.side_by_side;
  options.labels = !arguments.no_labels;
  options.conceal = arguments.conceal;
  options.quiet = arguments.quiet;
  check_together(options, arguments);
  return options;
}

}  // namespace tvg::cli
