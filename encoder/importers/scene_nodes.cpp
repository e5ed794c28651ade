#include "encoder/importers/scene_nodes.hpp"

namespace tvg::cli {

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

}  // namespace tvg::cli
