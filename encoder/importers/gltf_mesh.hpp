#pragma once
#include "encoder/importers/gltf_accessors.hpp"
#include "encoder/importers/scene_reader.hpp"

#include <vector>

namespace tvg::cli {

/// A mesh of glTF, a part for each primitive that has positions. Throws ImportError.
std::vector<ScenePart> read_gltf_mesh(const Scene& scene, const tinygltf::Mesh& mesh, const std::string& name,
                                      GltfAccessors& accessors, bool with_attributes);

}  // namespace tvg::cli
