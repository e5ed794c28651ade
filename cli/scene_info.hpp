#pragma once
#include <string>

namespace tvg::cli {

/// Whether `tvg info` reads `path` as a scene or a BVH file, and not as a stream.
bool has_scene_info(const std::string& path);

/// Prints the clips, meshes and joints of a scene. `fps` is the rate that frames are counted at, as a user
/// types it. Throws ToolError.
void print_scene_info(const std::string& path, const std::string& fps, bool json);

}  // namespace tvg::cli
