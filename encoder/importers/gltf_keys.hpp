#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace tvg::cli {

/// How the keys of a glTF clip are joined, as far as assimp does not tell or read it.
struct GltfKeys {
  bool has_steps = false;          ///< some channel holds each key's value until the next
  bool has_curves = false;         ///< some channel is a cubic spline
  bool has_curved_morphs = false;  ///< a cubic spline of morph weights, which assimp 5.2 reads wrongly
};

/// Looks into the JSON of a .gltf or .glb file that assimp has accepted. Nothing is found in other files.
GltfKeys find_gltf_keys(const std::string& path, std::size_t clip);

/// The same of the bytes of such a file.
GltfKeys parse_gltf_keys(std::string_view bytes, std::size_t clip);

}  // namespace tvg::cli
