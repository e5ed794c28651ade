#pragma once
#include "encoder/importers/gltf_accessors.hpp"
#include "encoder/importers/scene_reader.hpp"

#include <vector>

namespace tvg::cli {

/// Where a node's mesh stands within it: once at its origin, or as often as EXT_mesh_gpu_instancing says,
/// `most` times at most. Throws ImportError.
std::vector<Transform> read_gltf_instances(const Scene& scene, const tinygltf::Node& node,
                                           const std::string& name, GltfAccessors& accessors,
                                           std::uint64_t most);

}  // namespace tvg::cli
