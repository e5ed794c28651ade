#pragma once
#include <string>
#include <vector>

#include <tvg/properties.hpp>

struct aiScene;

namespace tvg::cli {

/// Names of the materials, [material], unique; empty for what stands for none in files without materials.
std::vector<std::string> name_assimp_materials(const aiScene& scene);

/// What NamedData calls "materials" and "image/...", of materials with these names; with
/// `embed_textures` the files of textures too. Notes, beginning with
/// `path`, what is left out.
std::vector<NamedData> read_assimp_data(const std::string& path, const aiScene& scene,
                                        const std::vector<std::string>& names, bool embed_textures,
                                        std::vector<std::string>& notes);

}  // namespace tvg::cli
