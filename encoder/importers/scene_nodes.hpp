#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace tvg::cli {

using Transform = Eigen::Affine3d;

/// One node of a scene.
struct SceneNode {
  std::string name;
  std::int32_t parent = -1;
  Transform local = Transform::Identity();  ///< to its parent's space, where no clip moves it
};

/// The nodes of a scene, parents first.
class SceneNodes {
 public:
  SceneNodes() = default;
  explicit SceneNodes(std::vector<SceneNode> nodes) : nodes_(std::move(nodes)) {}

  const std::vector<SceneNode>& list() const { return nodes_; }
  /// Transforms to the scene's space, [node], of local ones.
  void to_scene_space(const std::vector<Transform>& local, std::vector<Transform>& global) const;
  /// Local transforms where no clip moves a node, [node].
  std::vector<Transform> rest_pose() const;

 private:
  std::vector<SceneNode> nodes_;
};

}  // namespace tvg::cli
