#include "encoder/importers/gltf_nodes.hpp"

#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

Transform from_columns(const std::vector<double>& numbers) {
  Transform transform = Transform::Identity();
  transform.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix4d>(numbers.data()).topRows<3>();
  return transform;
}

/// The nearest placement; shear is lost.
Placement decomposed(const Transform& transform) {
  Placement place;
  place.position = transform.translation();
  Eigen::Matrix3d linear = transform.linear();
  for (Eigen::Index axis = 0; axis < 3; ++axis) place.scale[axis] = linear.col(axis).norm();
  if (linear.determinant() < 0) place.scale[0] = -place.scale[0];
  if (!(place.scale.cwiseAbs().minCoeff() > 1e-12)) return place;
  for (Eigen::Index axis = 0; axis < 3; ++axis) linear.col(axis) /= place.scale[axis];
  place.rotation = Eigen::Quaterniond(linear).normalized();
  return place;
}

class NodeReader {
 public:
  NodeReader(const GltfDocument& document, Scene& scene, GltfNodes& nodes)
      : model_(document.model), scene_(scene), nodes_(nodes) {}

  void read() {
    find_parents();
    check_cycles();
    nodes_.place.assign(model_.nodes.size(), kNowhere);
    nodes_.rest.resize(model_.nodes.size());
    for (const std::size_t root : roots()) take_tree(root, true);
    for (std::size_t node = 0; node < model_.nodes.size(); ++node) {
      if (parent_[node] == kNowhere && nodes_.place[node] == kNowhere) take_tree(node, false);
    }
    scene_.nodes = SceneNodes(std::move(list_));
  }

 private:
  std::size_t checked(int node, const std::string& whose) const {
    if (node < 0 || static_cast<std::size_t>(node) >= model_.nodes.size()) {
      scene_.fail(fmt::format("{} has the node {}, and there are {}", whose, node, model_.nodes.size()));
    }
    return static_cast<std::size_t>(node);
  }

  void find_parents() {
    parent_.assign(model_.nodes.size(), kNowhere);
    for (std::size_t node = 0; node < model_.nodes.size(); ++node) {
      for (const int below : model_.nodes[node].children) {
        const std::size_t child = checked(below, fmt::format("node {}", node));
        if (parent_[child] != kNowhere) scene_.fail(fmt::format("node {} has two parents", child));
        parent_[child] = node;
      }
    }
  }

  /// Each has one parent at most, so that what no root leads to goes round.
  void check_cycles() const {
    std::vector<char> reached(parent_.size(), 0);
    std::vector<std::size_t> pending;
    for (std::size_t node = 0; node < parent_.size(); ++node) {
      if (parent_[node] == kNowhere) pending.push_back(node);
    }
    while (!pending.empty()) {
      const std::size_t node = pending.back();
      pending.pop_back();
      reached[node] = 1;
      for (const int child : model_.nodes[node].children) pending.push_back(static_cast<std::size_t>(child));
    }
    for (std::size_t node = 0; node < reached.size(); ++node) {
      if (reached[node] == 0) scene_.fail(fmt::format("node {} is among those below it", node));
    }
  }

  std::vector<std::size_t> roots() {
    std::vector<std::size_t> roots;
    if (model_.scenes.empty()) {
      for (std::size_t node = 0; node < parent_.size(); ++node) {
        if (parent_[node] == kNowhere) roots.push_back(node);
      }
      return roots;
    }
    const int index = model_.defaultScene < 0 ? 0 : model_.defaultScene;
    if (static_cast<std::size_t>(index) >= model_.scenes.size()) {
      scene_.fail(fmt::format("scene {} is to be shown, and there are {}", index, model_.scenes.size()));
    }
    if (model_.scenes.size() > 1) {
      scene_.notes.push_back(fmt::format("{}: scene {} of {} is taken, counted from 0", scene_.path, index,
                                         model_.scenes.size()));
    }
    for (const int node : model_.scenes[static_cast<std::size_t>(index)].nodes) {
      roots.push_back(checked(node, fmt::format("scene {}", index)));
    }
    return roots;
  }

  /// A node and all below it, in the file's order. A root that is below another one is not taken again.
  void take_tree(std::size_t root, bool is_shown) {
    std::vector<std::size_t> pending = {root};
    while (!pending.empty()) {
      const std::size_t node = pending.back();
      pending.pop_back();
      if (nodes_.place[node] != kNowhere) continue;
      take_node(node);
      if (is_shown) take_mesh(node);
      const std::vector<int>& children = model_.nodes[node].children;
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        pending.push_back(static_cast<std::size_t>(*child));
      }
    }
  }

  void take_node(std::size_t node) {
    const tinygltf::Node& source = model_.nodes[node];
    SceneNode taken;
    taken.name = source.name.empty() ? fmt::format("node {}", node) : source.name;
    // A scene may name a root that is below a node of none.
    const std::size_t parent = parent_[node];
    const bool has_parent = parent != kNowhere && nodes_.place[parent] != kNowhere;
    taken.parent = has_parent ? static_cast<std::int32_t>(nodes_.place[parent]) : -1;
    if (has_size(source.matrix, 16, node)) {
      taken.local = from_columns(source.matrix);
      nodes_.rest[node] = decomposed(taken.local);
    } else {
      nodes_.rest[node] = read_placement(source, node);
      taken.local = nodes_.rest[node].transform();
    }
    nodes_.place[node] = list_.size();
    list_.push_back(std::move(taken));
  }

  bool has_size(const std::vector<double>& numbers, std::size_t size, std::size_t node) const {
    if (numbers.empty() || numbers.size() == size) return !numbers.empty();
    scene_.fail(
        fmt::format("node {} is placed by {} numbers where {} are wanted", node, numbers.size(), size));
  }

  Placement read_placement(const tinygltf::Node& source, std::size_t node) const {
    Placement place;
    if (has_size(source.translation, 3, node)) place.position = Eigen::Vector3d(source.translation.data());
    if (has_size(source.scale, 3, node)) place.scale = Eigen::Vector3d(source.scale.data());
    if (!has_size(source.rotation, 4, node)) return place;
    const Eigen::Quaterniond rotation(source.rotation.data());
    if (rotation.norm() > 1e-12) place.rotation = rotation.normalized();
    return place;
  }

  void take_mesh(std::size_t node) {
    const tinygltf::Node& source = model_.nodes[node];
    if (source.mesh < 0) return;
    const auto mesh = static_cast<std::size_t>(source.mesh);
    if (mesh >= model_.meshes.size()) {
      scene_.fail(fmt::format("node {} holds mesh {}, and there are {}", node, mesh, model_.meshes.size()));
    }
    SceneInstance instance{.node = nodes_.place[node], .mesh = mesh, .weights = source.weights};
    if (instance.weights.empty()) instance.weights = model_.meshes[mesh].weights;
    if (source.skin >= 0) instance.skin = static_cast<std::size_t>(source.skin);
    if (instance.skin && *instance.skin >= model_.skins.size()) {
      scene_.fail(
          fmt::format("node {} has skin {}, and there are {}", node, *instance.skin, model_.skins.size()));
    }
    scene_.instances.push_back(std::move(instance));
  }

  const tinygltf::Model& model_;
  Scene& scene_;
  GltfNodes& nodes_;
  std::vector<std::size_t> parent_;  // [node]
  std::vector<SceneNode> list_;
};

}  // namespace

void read_gltf_nodes(const GltfDocument& document, Scene& scene, GltfNodes& nodes) {
  NodeReader(document, scene, nodes).read();
}

}  // namespace tvg::cli
