#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <tvg/levels.hpp>
#include <tvg/measure.hpp>
#include <tvg/source.hpp>

namespace CLI {
class App;
}

namespace tvg::cli {

/// Values of the options as typed.
struct LevelArguments {
  std::string levels = "own";
  std::uint32_t lods = 0;
  std::optional<double> lod_ratio;
  bool quiet = false;

  /// Whether the mesh is to be simplified.
  bool any() const { return levels == "simplify" || lods > 0; }
};

/// Declares --levels, --lod and --lod-ratio; `arguments` must outlive the parsing.
void add_level_options(CLI::App& command, LevelArguments& arguments);

/// What simplifying the frames of a source, as many as memory holds, makes of its mesh: levels, and the
/// coarser meshes asked for. The source is rewound. Null where nothing is asked for. Throws ToolError: kUsage
/// for options that do not go together, a mesh that is too small, and a source that can be read only once;
/// and as hold_frames() and simplify() do. `names`: of the inputs.
std::shared_ptr<const MeshLevels> simplified_levels(FrameSource& source, const LevelArguments& arguments,
                                                    const Importance& importance, const std::string& names);

}  // namespace tvg::cli
