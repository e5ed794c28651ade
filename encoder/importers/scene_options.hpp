#pragma once
#include <string>
#include <vector>

namespace tvg::cli {

/// What a user wants of a scene; ignored for other inputs.
struct SceneOptions {
  /// Name of the clip, or its number counted from 0 where no clip has that name; the first where empty.
  std::string clip;
  /// Names of meshes, or of the nodes that hold them; all meshes where empty.
  std::vector<std::string> meshes;
  /// Samples per second ("25", "30000/1001"); 30 where empty.
  std::string fps;
};

}  // namespace tvg::cli
