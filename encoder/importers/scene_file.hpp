#pragma once
#include <string>
#include <vector>

namespace tvg::cli {

/// The suffixes of scenes, for messages.
extern const char* const kSceneFormats;

/// Whether the suffix of `path` names a format that may hold clips, bones or vertex animation.
bool is_scene(const std::string& path);

/// `paths`, and after each scene the files beside it that its format may name: buffers, skeletons, motion.
std::vector<std::string> with_scene_files(const std::vector<std::string>& paths);

}  // namespace tvg::cli
