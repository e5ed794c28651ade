#pragma once
#include "player/view/camera.hpp"
#include "player/view/mesh_renderer.hpp"
#include "tool/source_opener.hpp"

#include <string>
#include <vector>

// How things are to look, as the commands that draw have it in common.
namespace tvg::player {

/// What colours the mesh.
enum class Overlay { kNone, kImportance, kCost, kError };

/// The name by which users know an overlay: "none", "importance", ...
const char* overlay_name(Overlay overlay);

/// The options as they are typed.
struct LookArguments {
  std::string size = "1280x720";
  std::string camera;
  std::string overlay = "none";
  std::vector<std::string> reference;
  std::string shading;
  std::string background;
  std::string up;
  std::string front;
  bool wireframe = false;
  bool grid = false;
  bool axes = false;
  bool plain = false;
};

/// What they mean.
struct Look {
  int width = 1280;  ///< pixels
  int height = 720;
  ViewAngles angles;
  ChosenOrientation orientation;
  bool axes = false;  ///< which way x, y and z go is shown in a corner
  Overlay overlay = Overlay::kNone;
  cli::SourceOpener open_source;       ///< opens a reference that is no .tvg
  std::vector<std::string> reference;  ///< inputs of the sequence to compare with; empty where there is none
  Style style;
  bool plain = false;             ///< one colour, whatever the input says of its surface
  bool shading_is_given = false;  ///< else that of the input's metadata goes
};

/// The shading that a sequence's metadata ask for (`shading`), else smooth.
Shading shading_of(const Metadata& metadata);

/// Throws ToolError (kUsage) that shows what would be right.
Look parse_look(const LookArguments& arguments);

}  // namespace tvg::player
