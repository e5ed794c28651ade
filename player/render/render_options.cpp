#include "player/render/render_options.hpp"

#include "cli/mesh_format.hpp"
#include "cli/option_values.hpp"
#include "cli/tool_error.hpp"
#include "player/render/video_writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace tvg::cli {

namespace {

constexpr int kMostPixels = 8192;
constexpr int kMostCells = 32;

[[noreturn]] void fail_usage(const std::string& option, const std::string& text, const std::string& right) {
  throw ToolError(ExitStatus::kUsage, fmt::format("{} {}: {}", option, text, right));
}

/// "AxB", both from 1 to `most`.
std::optional<std::pair<int, int>> parse_pair(std::string_view text, int most) {
  const std::size_t at = text.find('x');
  if (at == std::string_view::npos) return std::nullopt;
  const auto number = [most](std::string_view part) {
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    const bool whole = error == std::errc() && end == part.data() + part.size();
    return whole && value >= 1 && value <= most ? value : 0;
  };
  const std::pair pair(number(text.substr(0, at)), number(text.substr(at + 1)));
  if (pair.first == 0 || pair.second == 0) return std::nullopt;
  return pair;
}

std::optional<double> parse_positive(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value) || !(value > 0)) return std::nullopt;
  return value;
}

/// "#rrggbb"
std::optional<Colour> parse_colour(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::array<float, 3> parts{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    unsigned value = 0;
    const char* begin = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(begin, begin + 2, value, 16);
    if (error != std::errc() || end != begin + 2) return std::nullopt;
    parts[i] = static_cast<float>(value) / 255;
  }
  return Colour{parts[0], parts[1], parts[2]};
}

void set_background(Style& style, const std::string& text) {
  if (text.empty()) return;
  if (text == "dark") {
    style.background_top = {0.20F, 0.215F, 0.24F};
    style.background_bottom = {0.10F, 0.11F, 0.13F};
  } else if (text == "white") {
    style.background_top = style.background_bottom = {1, 1, 1};
  } else if (const std::optional<Colour> colour = parse_colour(text)) {
    style.background_top = style.background_bottom = *colour;
  } else if (text != "light") {
    fail_usage("--background", text, "write light, dark, white or a colour as #rrggbb");
  }
}

Overlay parse_overlay(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, Overlay>, 4> kNames = {
      {{"none", Overlay::kNone},
       {"importance", Overlay::kImportance},
       {"cost", Overlay::kCost},
       {"error", Overlay::kError}}};
  for (const auto& [name, overlay] : kNames) {
    if (text == name) return overlay;
  }
  fail_usage("--overlay", text, "write none, importance, cost or error");
}

void set_output(RenderOptions& options, const std::string& output) {
  options.output = output;
  if (is_video_name(output)) {
    options.kind = RenderOptions::Output::kVideo;
  } else if (!has_suffix(output, ".png") && output != "-") {
    fail_usage("-o", output, "write a picture (.png), pictures (out%04d.png) or a clip (.mp4, .webm, .mkv)");
  } else if ((options.pattern = parse_frame_pattern(output))) {
    options.kind = RenderOptions::Output::kFrames;
  }
}

void check_together(const RenderOptions& options, const RenderArguments& arguments) {
  const bool video = options.kind == RenderOptions::Output::kVideo;
  if (video && (options.width % 2 != 0 || options.height % 2 != 0)) {
    fail_usage("--size", arguments.size, "a clip needs even numbers");
  }
  if (options.sheet && options.kind != RenderOptions::Output::kPicture) {
    fail_usage("--sheet", arguments.sheet,
               "a contact sheet is one picture: write it to a .png without a frame's number");
  }
  if (options.sheet &&
      (options.width / options.sheet->columns < 16 || options.height / options.sheet->rows < 16)) {
    fail_usage("--sheet", arguments.sheet, "the pictures would be under 16 pixels: give a larger --size");
  }
  if (options.fps && !video) fail_usage("--fps", arguments.fps, "only a clip has frames per second");
  if (options.overlay == Overlay::kError && options.reference.empty()) {
    fail_usage("--overlay", "error", "name the reference with --ref");
  }
  if (options.side_by_side && options.reference.empty()) {
    throw ToolError(ExitStatus::kUsage, "--side-by-side: name the reference with --ref");
  }
  if (!options.reference.empty() && !options.side_by_side && options.overlay != Overlay::kError) {
    throw ToolError(ExitStatus::kUsage, "--ref: add --overlay error or --side-by-side to show it");
  }
  if (options.largest && options.overlay != Overlay::kCost && options.overlay != Overlay::kError) {
    fail_usage("--scale", arguments.scale, "only --overlay cost and error have a scale");
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
  options.inputs = arguments.inputs;
  options.reference = arguments.reference;
  set_output(options, arguments.output);
  if (!arguments.frames.empty()) options.frames = parse_frame_range(arguments.frames);
  const auto size = parse_pair(arguments.size, kMostPixels);
  if (!size || size->first < 16 || size->second < 16) {
    fail_usage("--size", arguments.size,
               fmt::format("write width and height in pixels, 16 to {}, as 1280x720", kMostPixels));
  }
  std::tie(options.width, options.height) = *size;
  if (!arguments.camera.empty()) options.angles = parse_view(arguments.camera);
  options.overlay = parse_overlay(arguments.overlay);
  if (!arguments.scale.empty() && !(options.largest = parse_positive(arguments.scale))) {
    fail_usage("--scale", arguments.scale, "write the value of the last colour, above 0");
  }
  if (arguments.shading != "smooth" && arguments.shading != "flat") {
    fail_usage("--shading", arguments.shading, "write smooth or flat");
  }
  options.style.shading = arguments.shading == "flat" ? Shading::kFlat : Shading::kSmooth;
  options.style.wireframe = arguments.wireframe;
  options.style.grid = arguments.grid;
  set_background(options.style, arguments.background);
  if (!arguments.sheet.empty()) {
    const auto shape = parse_pair(arguments.sheet, kMostCells);
    if (!shape)
      fail_usage("--sheet", arguments.sheet,
                 fmt::format("write columns and rows, 1 to {}, as 4x3", kMostCells));
    options.sheet = {shape->first, shape->second};
  }
  if (!arguments.fps.empty()) {
    if (!is_frame_rate(arguments.fps))
      fail_usage("--fps", arguments.fps, "write frames per second as 30 or 30000/1001");
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
