#include "encoder/importers/scene_nodes.hpp"

#include <assimp/scene.h>

namespace tvg::cli {

Transform to_transform(const aiMatrix4x4& matrix) {
  Transform transform = Transform::Identity();
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      transform.matrix()(row, column) = double{matrix[row][column]};
    }
  }
  return transform;
}

SceneNodes::SceneNodes(const aiScene& scene) {
  struct Pending {
    const aiNode* node;
    std::int32_t parent;
  };
  std::vector<Pending> pending = {{scene.mRootNode, -1}};
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    if (next.node == nullptr) continue;
    const auto index = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back(
        {next.node->mName.C_Str(), next.parent, to_transform(next.node->mTransformation), next.node});
    by_name_.emplace(nodes_.back().name, index);
    for (unsigned child = next.node->mNumChildren; child > 0; --child) {
      pending.push_back({next.node->mChildren[child - 1], index});
    }
  }
}

std::int32_t SceneNodes::find(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? -1 : found->second;
}

void SceneNodes::to_scene_space(const std::vector<Transform>& local, std::vector<Transform>& global) const {
  global.resize(nodes_.size());
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    const std::int32_t parent = nodes_[node].parent;
    global[node] = parent < 0 ? local[node] : global[static_cast<std::size_t>(parent)] * local[node];
  }
}

std::vector<Transform> SceneNodes::rest_pose() const {
  std::vector<Transform> pose;
  pose.reserve(nodes_.size());
  for (const SceneNode& node : nodes_) pose.push_back(node.local);
  return pose;
}

void SceneNodes::detach() {
  for (SceneNode& node : nodes_) node.source = nullptr;
}

}  // namespace tvg::cli
