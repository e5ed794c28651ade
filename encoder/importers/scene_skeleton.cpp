#include "encoder/importers/scene_skeleton.hpp"

#include <algorithm>

namespace tvg::cli {

namespace {

/// FBX gives a joint up to eleven transforms; assimp makes nodes of them, which are no joints of the rig.
bool is_helper(const SceneNode& node) {
  return node.name.find("_$AssimpFbx$_") != std::string::npos;
}

/// The joint of each node: itself, else the nearest above; -1 where there is none.
std::vector<std::int32_t> nearest_joints(const SceneNodes& nodes, const std::vector<char>& is_joint,
                                         SceneSkeleton& result) {
  std::vector<std::int32_t> nearest(nodes.list().size(), -1);
  for (std::size_t node = 0; node < nodes.list().size(); ++node) {
    const std::int32_t parent = nodes.list()[node].parent;
    const std::int32_t above = parent < 0 ? -1 : nearest[static_cast<std::size_t>(parent)];
    nearest[node] = above;
    if (is_joint[node] == 0) continue;
    nearest[node] = static_cast<std::int32_t>(result.nodes.size());
    result.nodes.push_back(node);
    result.skeleton.joint_names.push_back(nodes.list()[node].name);
    result.skeleton.parents.push_back(above);
  }
  return nearest;
}

}  // namespace

void SceneSkeleton::pose(const std::vector<Transform>& global, std::vector<float>& out) const {
  out.clear();
  for (const std::size_t node : nodes) {
    const Eigen::Vector3d place = global[node].translation();
    for (const double value : place) out.push_back(static_cast<float>(value));
  }
}

SceneSkeleton find_skeleton(const SceneNodes& nodes, const SceneMesh& mesh) {
  const std::size_t count = nodes.list().size();
  std::vector<char> is_bone(count, 0);
  std::vector<char> bone_below(count, 0);  // including itself
  bool any = false;
  for (const Carrier& carrier : mesh.carriers) {
    if (!carrier.is_bone) continue;
    is_bone[carrier.node] = 1;
    any = true;
  }
  SceneSkeleton result;
  if (!any) return result;
  for (std::size_t node = count; node > 0; --node) {
    bone_below[node - 1] |= is_bone[node - 1];
    const std::int32_t parent = nodes.list()[node - 1].parent;
    if (parent >= 0) bone_below[static_cast<std::size_t>(parent)] |= bone_below[node - 1];
  }
  std::vector<char> bone_above(count, 0);
  std::vector<char> is_joint(count, 0);
  for (std::size_t node = 0; node < count; ++node) {
    const std::int32_t parent = nodes.list()[node].parent;
    if (parent >= 0) {
      bone_above[node] =
          bone_above[static_cast<std::size_t>(parent)] | is_bone[static_cast<std::size_t>(parent)];
    }
    const bool between = bone_above[node] != 0 && bone_below[node] != 0 && !is_helper(nodes.list()[node]);
    is_joint[node] = is_bone[node] != 0 || between ? 1 : 0;
  }
  const std::vector<std::int32_t> nearest = nearest_joints(nodes, is_joint, result);

  result.skeleton.heaviest_joint.reserve(mesh.positions.size());
  for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    const auto influences = mesh.influences_of(vertex);
    const auto heaviest =
        std::max_element(influences.begin(), influences.end(),
                         [](const Influence& x, const Influence& y) { return x.weight < y.weight; });
    const std::int32_t joint = nearest[mesh.carriers[heaviest->carrier].node];
    result.skeleton.heaviest_joint.push_back(joint < 0 ? 0 : static_cast<std::uint32_t>(joint));
  }
  return result;
}

SceneSkeleton find_moved_nodes(const SceneNodes& nodes, const Clip& clip) {
  std::vector<char> is_joint(nodes.list().size(), 0);
  for (const NodeChannel& channel : clip.nodes) is_joint[channel.node] = 1;
  for (std::size_t node = 0; node < is_joint.size(); ++node) {
    const std::int32_t parent = nodes.list()[node].parent;
    if (parent >= 0) is_joint[node] |= is_joint[static_cast<std::size_t>(parent)];
  }
  SceneSkeleton result;
  nearest_joints(nodes, is_joint, result);
  return result;
}

}  // namespace tvg::cli
