#pragma once
#include "cli/frame_pattern.hpp"
#include "encoder/importers/frame_range.hpp"
#include "player/view/camera.hpp"
#include "player/view/mesh_renderer.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tvg::cli {

enum class Overlay { kNone, kImportance, kCost, kError };

/// The options of `tvg render` as they are typed.
struct RenderArguments {
  std::vector<std::string> inputs;
  std::string output;
  std::string frames;
  std::string size = "1280x720";
  std::string camera;
  std::string overlay = "none";
  std::vector<std::string> reference;
  std::string scale;
  std::string shading = "smooth";
  std::string background;
  std::string sheet;
  std::string fps;
  bool side_by_side = false;
  bool wireframe = false;
  bool grid = false;
  bool no_labels = false;
  bool conceal = false;
  bool quiet = false;
};

/// Columns and rows of a contact sheet.
struct SheetShape {
  int columns = 0;
  int rows = 0;
};

/// What they mean.
struct RenderOptions {
  enum class Output { kFrames, kPicture, kVideo };

  std::vector<std::string> inputs;
  std::vector<std::string> reference;
  std::string output;
  Output kind = Output::kPicture;
  std::optional<FramePattern> pattern;  ///< kFrames: names of the pictures
  std::optional<FrameRange> frames;
  int width = 0;  ///< of a picture, pixels
  int height = 0;
  ViewAngles angles;
  Overlay overlay = Overlay::kNone;
  std::optional<double> largest;  ///< value at the upper end of the colours, in the overlay's units
  std::optional<SheetShape> sheet;
  std::optional<std::string> fps;  ///< "30" or "30000/1001"
  Style style;
  bool side_by_side = false;
  bool labels = true;
  bool conceal = false;
  bool quiet = false;
};

/// Throws ToolError (kUsage) that shows what would be right, also for options that do not go together.
RenderOptions parse_render_arguments(const RenderArguments& arguments);

/// Whether `text` is a frame rate as metadata and `--fps` have it: "30", "23.976", "30000/1001".
bool is_frame_rate(const std::string& text);

}  // namespace tvg::cli
