#pragma once
#include <Eigen/Geometry>
#include <assimp/matrix4x4.h>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

struct aiNode;
struct aiScene;

namespace tvg::cli {

using Transform = Eigen::Affine3d;

/// One node of a scene. Nodes are listed parents first, in the file's order.
struct SceneNode {
  std::string name;
  std::int32_t parent = -1;
  Transform local = Transform::Identity();  ///< to its parent's space, where no clip moves it
  const aiNode* source = nullptr;           ///< valid as long as the scene
};

/// The nodes of a scene.
class SceneNodes {
 public:
  explicit SceneNodes(const aiScene& scene);

  const std::vector<SceneNode>& list() const { return nodes_; }
  /// The first node of that name, or -1.
  std::int32_t find(const std::string& name) const;
  /// Transforms to the scene's space, [node], of local ones.
  void to_scene_space(const std::vector<Transform>& local, std::vector<Transform>& global) const;
  /// Local transforms where no clip moves a node, [node].
  std::vector<Transform> rest_pose() const;
  /// Forgets the scene, which may then be freed.
  void detach();

 private:
  std::vector<SceneNode> nodes_;
  std::unordered_map<std::string, std::int32_t> by_name_;
};

Transform to_transform(const aiMatrix4x4& matrix);

}  // namespace tvg::cli
