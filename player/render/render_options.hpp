#pragma once
#include "player/overlay/overlay_values.hpp"
#include "player/view/look.hpp"
#include "tool/frame_pattern.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tvg::player {

/// The options of `tvg render` as they are typed.
struct RenderArguments : LookArguments {
  std::vector<std::string> inputs;
  std::string output;
  std::string frames;
  std::string scale;
  std::string sheet;
  std::string fps;
  std::uint32_t lod = 0;
  bool side_by_side = false;
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
struct RenderOptions : Look {
  enum class Output { kFrames, kPicture, kVideo };

  std::vector<std::string> inputs;
  std::string output;
  Output kind = Output::kPicture;
  std::optional<cli::FramePattern> pattern;  ///< kFrames: names of the pictures
  std::optional<FrameRange> frames;
  cli::SourceOpener open_inputs;  ///< opens inputs that are no .tvg
  ShownMeasure measure;           ///< of Overlay::kCost
  std::optional<double> largest;  ///< value at the upper end of the colours, in the overlay's units
  std::optional<SheetShape> sheet;
  std::optional<std::string> fps;  ///< "30" or "30000/1001"
  std::uint32_t lod = 0;           ///< of a .tvg: which coarser mesh is drawn; 0 the whole
  bool side_by_side = false;
  bool labels = true;
  bool conceal = false;
  bool quiet = false;
};

/// Throws ToolError (kUsage) that shows what would be right, also for options that do not go together.
RenderOptions parse_render_arguments(const RenderArguments& arguments);

}  // namespace tvg::player
