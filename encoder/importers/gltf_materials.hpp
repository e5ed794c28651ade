#pragma once
#include "encoder/importers/gltf_accessors.hpp"

#include <string>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::cli {

/// Gives the materials of a document names of their own, in its JSON too, and returns them.
std::vector<std::string> name_gltf_materials(GltfDocument& document);

/// What NamedData calls "materials", "image/..." and "extras" of a document, as it has them: images that are
/// in views or data URIs become data, and those that are files with `embed_textures`. Notes what cannot be
/// read, or is more than the bytes that there are.
std::vector<NamedData> read_gltf_data(const std::string& path, const GltfDocument& document,
                                      GltfAccessors& accessors, bool embed_textures,
                                      std::vector<std::string>& notes);

}  // namespace tvg::cli
