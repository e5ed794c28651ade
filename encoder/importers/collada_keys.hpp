#pragma once
#include "encoder/importers/scene_clip.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tvg::cli {

/// How the keys of a COLLADA file are joined, which assimp does not tell.
struct ColladaKeys {
  bool has_lines = false;
  bool has_steps = false;
  bool has_curves = false;          ///< Bezier, Hermite and other splines
  std::vector<std::size_t> counts;  ///< keys of each list of interpolations
};

/// Looks for the lists of interpolations in the text of a COLLADA file.
ColladaKeys find_collada_keys(std::string_view text);

/// Lets the tracks of a clip step where all of its file step and assimp has left their keys as they were;
/// otherwise notes what is read as lines.
void restore_collada_keys(const std::string& path, Clip& clip, std::vector<std::string>& notes);

}  // namespace tvg::cli
