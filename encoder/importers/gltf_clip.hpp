#pragma once
#include "encoder/importers/gltf_accessors.hpp"
#include "encoder/importers/scene_reader.hpp"

#include <string>
#include <vector>

namespace tvg::cli {

/// What the clips of glTF need of its nodes.
struct GltfNodes {
  std::vector<std::size_t> place;  ///< [node of the file], its number in the scene
  std::vector<Placement> rest;     ///< [node of the file], where no clip moves it
};

/// A clip of glTF, finished. Throws ImportError.
Clip read_gltf_clip(const Scene& scene, const GltfDocument& document, const GltfNodes& nodes,
                    std::size_t index, GltfAccessors& accessors);

}  // namespace tvg::cli
