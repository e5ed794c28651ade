#include "player/view/look.hpp"

#include "tool/option_values.hpp"

#include <array>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

namespace tvg::player {

namespace {

constexpr int kFewestPixels = 16;
constexpr int kMostPixels = 8192;

constexpr std::array<std::pair<Overlay, const char*>, 4> kOverlayNames = {
    {{Overlay::kNone, "none"},
     {Overlay::kImportance, "importance"},
     {Overlay::kCost, "cost"},
     {Overlay::kError, "error"}}};

Overlay parse_overlay(const std::string& text) {
  for (const auto& [overlay, name] : kOverlayNames) {
    if (text == name) return overlay;
  }
  cli::fail_option("--overlay", text, "write none, importance, cost or error");
}

std::optional<AxisDirection> parse_direction(const char* option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::optional<AxisDirection> direction = parse_axis_direction(text);
  if (!direction) cli::fail_option(option, text, "write +X, -X, +Y, -Y, +Z or -Z");
  return direction;
}

/// "#rrggbb"
std::optional<cli::Colour> parse_colour(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::array<float, 3> parts{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    unsigned value = 0;
    const char* begin = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(begin, begin + 2, value, 16);
    if (error != std::errc() || end != begin + 2) return std::nullopt;
    parts[i] = static_cast<float>(value) / 255;
  }
  return cli::Colour{parts[0], parts[1], parts[2]};
}

void set_background(Style& style, const std::string& text) {
  if (text.empty()) return;
  if (text == "dark") {
    style.background_top = {0.20F, 0.215F, 0.24F};
    style.background_bottom = {0.10F, 0.11F, 0.13F};
  } else if (text == "white") {
    style.background_top = style.background_bottom = {1, 1, 1};
  } else if (const std::optional<cli::Colour> colour = parse_colour(text)) {
    style.background_top = style.background_bottom = *colour;
  } else if (text != "light") {
    cli::fail_option("--background", text, "write light, dark, white or a colour as #rrggbb");
  }
}

}  // namespace

const char* overlay_name(Overlay overlay) {
  for (const auto& [known, name] : kOverlayNames) {
    if (overlay == known) return name;
  }
  return "";
}

Shading shading_of(const Metadata& metadata) {
  const auto shading = metadata.find("shading");
  return shading != metadata.end() && shading->second == "flat" ? Shading::kFlat : Shading::kSmooth;
}

Look parse_look(const LookArguments& arguments) {
  Look look;
  const auto size = cli::parse_count_pair(arguments.size, kMostPixels);
  if (!size || size->first < kFewestPixels || size->second < kFewestPixels) {
    cli::fail_option(
        "--size", arguments.size,
        fmt::format("write width and height in pixels, {} to {}, as 1280x720", kFewestPixels, kMostPixels));
  }
  std::tie(look.width, look.height) = *size;
  if (!arguments.camera.empty()) look.angles = parse_view(arguments.camera);
  look.orientation.up = parse_direction("--up", arguments.up);
  look.orientation.front = parse_direction("--front", arguments.front);
  if (look.orientation.up) static_cast<void>(look.orientation.of({}));  // refuses a front that is up
  look.axes = arguments.axes;
  look.overlay = parse_overlay(arguments.overlay);
  look.reference = arguments.reference;
  if (look.overlay == Overlay::kError && look.reference.empty()) {
    cli::fail_option("--overlay", "error", "name the reference with --ref");
  }
  if (!arguments.shading.empty() && arguments.shading != "smooth" && arguments.shading != "flat") {
    cli::fail_option("--shading", arguments.shading, "write smooth or flat");
  }
  look.style.shading = arguments.shading == "flat" ? Shading::kFlat : Shading::kSmooth;
  look.shading_is_given = !arguments.shading.empty();
  look.plain = arguments.plain;
  look.style.wireframe = arguments.wireframe;
  look.style.grid = arguments.grid;
  set_background(look.style, arguments.background);
  return look;
}

}  // namespace tvg::player
