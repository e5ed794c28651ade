#pragma once
#include <string>
#include <tiny_gltf.h>

namespace tvg::cli {

/// Reads the JSON of a glTF 2 file, which names no buffers and images, into tinygltf's form. Its depth has
/// been bounded: tinygltf recurses over extensions and extras. False, and tinygltf's reason, where it is
/// refused.
bool load_gltf_model(const std::string& json, tinygltf::Model& model, std::string& reason);

}  // namespace tvg::cli
