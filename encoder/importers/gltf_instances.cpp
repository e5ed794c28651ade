#include "encoder/importers/gltf_instances.hpp"

#include <fmt/format.h>

namespace tvg::cli {

namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

/// The lists of a node: what is not given stays as it is.
class InstanceReader {
 public:
  InstanceReader(const Scene& scene, const tinygltf::Value& attributes, std::string name,
                 GltfAccessors& accessors, std::uint64_t most)
      : scene_(scene), attributes_(attributes), name_(std::move(name)), accessors_(accessors), most_(most) {}

  std::vector<Transform> read() {
    const std::vector<double> positions = read_list("TRANSLATION", 3);
    const std::vector<double> rotations = read_list("ROTATION", 4);
    const std::vector<double> scales = read_list("SCALE", 3);
    std::vector<Transform> placed;
    for (std::size_t i = 0; i < count_.value_or(0); ++i) {
      Placement place;
      if (!positions.empty()) place.position = Eigen::Vector3d(&positions[3 * i]);
      if (!scales.empty()) place.scale = Eigen::Vector3d(&scales[3 * i]);
      const Eigen::Quaterniond rotation =
          rotations.empty() ? place.rotation : Eigen::Quaterniond(&rotations[4 * i]);
      if (rotation.norm() > 1e-12) place.rotation = rotation.normalized();
      placed.push_back(place.transform());
    }
    return placed;
  }

 private:
  std::vector<double> read_list(const char* attribute, std::size_t width) {
    if (!attributes_.Has(attribute)) return {};
    const tinygltf::Value& accessor = attributes_.Get(attribute);
    if (!accessor.IsInt()) return {};
    const std::string what = fmt::format("node \"{}\", {} of {}", name_, attribute, kExtension);
    const std::uint64_t count = accessors_.count(accessor.Get<int>(), what);
    if (count > most_) scene_.fail(fmt::format("{} has {} elements: {} are read", what, count, most_));
    if (count_ && *count_ != count) {
      scene_.fail(fmt::format("{} has {} elements where others have {}", what, count, *count_));
    }
    count_ = count;
    return accessors_.read(accessor.Get<int>(), width, what);
  }

  const Scene& scene_;
  const tinygltf::Value& attributes_;
  std::string name_;
  GltfAccessors& accessors_;
  std::uint64_t most_;
  std::optional<std::uint64_t> count_;
};

}  // namespace

std::vector<Transform> read_gltf_instances(const Scene& scene, const tinygltf::Node& node,
                                           const std::string& name, GltfAccessors& accessors,
                                           std::uint64_t most) {
  const auto found = node.extensions.find(kExtension);
  if (found == node.extensions.end()) return {Transform::Identity()};
  const tinygltf::Value& attributes = found->second.Get("attributes");
  return InstanceReader(scene, attributes, name, accessors, most).read();
}

}  // namespace tvg::cli
