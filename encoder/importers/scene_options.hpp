#pragma once
#include "encoder/importers/property_options.hpp"

#include <optional>
#include <string>
#include <vector>

#include <tvg/types.hpp>

namespace tvg::cli {

/// What a user wants of a scene; ignored for other inputs.
struct SceneOptions {
  /// Name of the clip, or its number counted from 0 where no clip has that name; the first where empty.
  std::string clip = {};
  /// Names of meshes, or of the nodes that hold them; all meshes where empty.
  std::vector<std::string> meshes = {};
  /// Samples per second ("25", "30000/1001"); 30 where empty.
  std::string fps = {};
  /// What is kept beside positions; open_source() takes what its sequences do.
  PropertyOptions properties = {};
  /// Whether the skeleton and where its joints are in each frame go with the data.
  bool skeleton_data = false;
  /// The frames that are used, of which the skeleton's data are then; all where absent.
  std::optional<FrameRange> frames = {};
};

}  // namespace tvg::cli
