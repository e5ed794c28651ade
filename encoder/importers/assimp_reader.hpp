#pragma once
#include "encoder/importers/scene_reader.hpp"

namespace tvg::cli {

/// Opens a scene through assimp (see read_scene). assimp knows nodes by their names alone: of several that
/// have the same, clips and bones mean the first.
std::unique_ptr<SceneReader> read_assimp_scene(const std::string& path,
                                               std::optional<std::uint32_t> keyframe);

}  // namespace tvg::cli
