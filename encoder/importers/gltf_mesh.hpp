#pragma once
#include "encoder/importers/gltf_accessors.hpp"
#include "encoder/importers/scene_reader.hpp"

#include <vector>

namespace tvg::cli {

/// A mesh of glTF, a part for each primitive that has positions. `is_own`: GltfDocument::is_own. Throws
/// ImportError.
std::vector<ScenePart> read_gltf_mesh(const Scene& scene, const tinygltf::Mesh& mesh, const std::string& name,
                                      GltfAccessors& accessors, bool with_attributes, bool is_own);

}  // namespace tvg::cli
