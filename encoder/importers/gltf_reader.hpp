#pragma once
#include "encoder/importers/gltf_accessors.hpp"
#include "encoder/importers/scene_reader.hpp"

namespace tvg::cli {

/// Opens a glTF 2 file; nothing for one of glTF 1, which is assimp's (see read_scene).
std::unique_ptr<SceneReader> read_gltf_scene(const std::string& path);

/// The same of the bytes of such a file; `path` is its name for messages. The reader may be used while
/// `read_file`, which gives external buffers, may.
std::unique_ptr<SceneReader> parse_gltf_scene(const std::string& path, std::string bytes,
                                              GltfFileReader read_file, const GltfLimits& limits = {});

}  // namespace tvg::cli
