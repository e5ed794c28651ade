#pragma once
#include "encoder/importers/scene_reader.hpp"

#include <cstdint>
#include <functional>

struct aiAnimation;
struct aiNode;
struct aiScene;

namespace tvg::cli {

/// What the clips of assimp's need of a scene.
struct AssimpNames {
  std::function<std::int32_t(const std::string&)> node;  ///< the first of that name, or -1
  std::vector<const aiNode*> nodes;                      ///< [node]
};

/// Reads a clip, in seconds: a file that says no ticks per second has those its format is known for, with a
/// note. Throws ImportError (kInvalidInput).
Clip read_assimp_clip(const Scene& scene, const AssimpNames& names, const aiAnimation& animation,
                      std::vector<std::string>& notes);

}  // namespace tvg::cli
