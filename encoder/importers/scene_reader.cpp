#include "encoder/importers/scene_reader.hpp"

#include "encoder/importers/assimp_reader.hpp"
#include "encoder/importers/gltf_reader.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"
#include "tool/mesh_format.hpp"

#include <fmt/format.h>

namespace tvg::cli {

void Scene::fail(const std::string& what) const {
  throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: {}", path, what));
}

std::unique_ptr<SceneReader> read_scene(const std::string& path, std::optional<std::uint32_t> keyframe) {
  // A file that is not there, or may not be read, is told in the system's own words.
  require_regular_file(path);
  const InputFile readable(path);
  if (has_suffix(path, ".gltf") || has_suffix(path, ".glb")) {
    if (std::unique_ptr<SceneReader> reader = read_gltf_scene(path)) return reader;
  }
  return read_assimp_scene(path, keyframe);
}

}  // namespace tvg::cli
