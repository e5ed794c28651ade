#pragma once
#include "encoder/importers/scene_mesh.hpp"

#include <cstdint>
#include <vector>

#include <tvg/skeleton.hpp>

namespace tvg::cli {

/// A skeleton and the nodes its joints are.
struct SceneSkeleton {
  Skeleton skeleton;
  std::vector<std::size_t> nodes;  ///< [joint]

  /// Places of the joints, [joint][xyz], where nodes stand at `global` ([node], to the scene's space).
  void pose(const std::vector<Transform>& global, std::vector<float>& out) const;
};

/// The joints that move `mesh`: its bones and the nodes between one bone and another; empty where nothing is
/// skinned. A vertex without weights belongs to the nearest joint above its node, or else to the first joint.
SceneSkeleton find_skeleton(const SceneNodes& nodes, const SceneMesh& mesh);

/// The nodes that a clip moves and all below them, such as a motion capture's joints and end sites.
SceneSkeleton find_moved_nodes(const SceneNodes& nodes, const Clip& clip);

}  // namespace tvg::cli
