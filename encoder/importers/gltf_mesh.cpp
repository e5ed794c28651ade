#include "encoder/importers/gltf_mesh.hpp"

#include "encoder/importers/gltf_attributes.hpp"
#include "encoder/importers/gltf_own_extras.hpp"

#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// The accessor of an attribute, or -1.
int find_attribute(const std::map<std::string, int>& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? -1 : found->second;
}

class PrimitiveReader {
 public:
  PrimitiveReader(const Scene& scene, const tinygltf::Primitive& primitive, std::string name,
                  GltfAccessors& accessors)
      : scene_(scene), primitive_(primitive), name_(std::move(name)), accessors_(accessors) {}

  ScenePart read(bool with_attributes) {
    read_positions();
    read_faces();
    if (part_.faces.empty()) return std::move(part_);
    read_weights();
    read_targets();
    if (with_attributes) {
      read_gltf_attributes(primitive_, name_, accessors_, part_);
      if (primitive_.material >= 0 &&
          static_cast<std::size_t>(primitive_.material) < scene_.material_names.size())
        part_.material = static_cast<std::size_t>(primitive_.material);
    }
    return std::move(part_);
  }

 private:
  std::string what(const std::string& attribute) const { return fmt::format("{}, {}", name_, attribute); }

  void read_positions() {
    const int accessor = find_attribute(primitive_.attributes, "POSITION");
    if (primitive_.extensions.contains(kDraco) && !accessors_.has_bytes(accessor, what("POSITION"))) {
      scene_.fail(
          fmt::format("{} is compressed by {}, which is not read: export it without Draco's compression, "
                      "or with meshoptimizer's (gltfpack -c)",
                      name_, kDraco));
    }
    const std::vector<double> values = accessors_.read(accessor, 3, what("POSITION"));
    count_ = values.size() / 3;
    if (count_ > std::numeric_limits<std::uint32_t>::max())
      scene_.fail(name_ + " has more vertices than 2^32");
    part_.positions.reserve(count_);
    for (std::size_t i = 0; i < values.size(); i += 3) {
      part_.positions.emplace_back(values[i], values[i + 1], values[i + 2]);
    }
  }

  void read_faces() {
    const bool indexed = primitive_.indices >= 0;
    std::vector<std::uint32_t> corners;
    if (indexed) corners = accessors_.read_numbers(primitive_.indices, 1, what("indices"));
    const std::size_t count = indexed ? corners.size() : count_;
    const auto corner = [&](std::size_t i) { return indexed ? corners[i] : static_cast<std::uint32_t>(i); };
    switch (primitive_.mode) {
      case TINYGLTF_MODE_POINTS:
      case TINYGLTF_MODE_LINE_LOOP:
        part_.left_out = count;
        return;
      case TINYGLTF_MODE_LINE:
        part_.left_out = count / 2;
        return;
      case TINYGLTF_MODE_LINE_STRIP:
        part_.left_out = count - std::min<std::size_t>(count, 1);
        return;
      case TINYGLTF_MODE_TRIANGLES:
        for (std::size_t i = 0; i + 2 < count; i += 3) {
          part_.faces.push_back({corner(i), corner(i + 1), corner(i + 2)});
        }
        return;
      case TINYGLTF_MODE_TRIANGLE_STRIP:
        // Every other triangle is turned, so that all look the same way.
        for (std::size_t i = 0; i + 2 < count; ++i) {
          part_.faces.push_back({corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)});
        }
        return;
      case TINYGLTF_MODE_TRIANGLE_FAN:
        for (std::size_t i = 1; i + 1 < count; ++i)
          part_.faces.push_back({corner(0), corner(i), corner(i + 1)});
        return;
      default:
        scene_.fail(fmt::format("{} has the mode {}", name_, primitive_.mode));
    }
  }

  void require_count(std::size_t count, const std::string& attribute) const {
    if (count == count_) return;
    scene_.fail(fmt::format("{}, {} is for {} vertices, and there are {}", name_, attribute, count, count_));
  }

  void read_weights() {
    for (int set = 0;; ++set) {
      const std::string joint_name = fmt::format("JOINTS_{}", set);
      const std::string weight_name = fmt::format("WEIGHTS_{}", set);
      const int joints_at = find_attribute(primitive_.attributes, joint_name);
      const int weights_at = find_attribute(primitive_.attributes, weight_name);
      if (joints_at < 0 || weights_at < 0) return;
      const std::vector<std::uint32_t> joints = accessors_.read_numbers(joints_at, 4, what(joint_name));
      const std::vector<double> weights = accessors_.read(weights_at, 4, what(weight_name), true);
      require_count(joints.size() / 4, joint_name);
      require_count(weights.size() / 4, weight_name);
      part_.weights.resize(count_);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] != 0) part_.weights[i / 4].push_back({joints[i], weights[i]});
      }
    }
  }

  void read_targets() {
    for (const std::map<std::string, int>& target : primitive_.targets) {
      const std::string name = fmt::format("morph target {}", part_.targets.size());
      std::vector<VertexShift>& shifts = part_.targets.emplace_back();
      const int accessor = find_attribute(target, "POSITION");
      if (accessor < 0) continue;
      require_count(accessors_.count(accessor, what(name)), name);
      // Without bytes it moves nothing.
      if (!accessors_.has_bytes(accessor, what(name))) continue;
      const std::vector<double> values = accessors_.read(accessor, 3, what(name));
      for (std::size_t i = 0; i < values.size(); i += 3) {
        const Eigen::Vector3d delta(values[i], values[i + 1], values[i + 2]);
        if (!delta.isZero(0)) shifts.push_back({static_cast<std::uint32_t>(i / 3), delta});
      }
    }
  }

  const Scene& scene_;
  const tinygltf::Primitive& primitive_;
  std::string name_;
  GltfAccessors& accessors_;
  std::size_t count_ = 0;
  ScenePart part_;
};

}  // namespace

std::vector<ScenePart> read_gltf_mesh(const Scene& scene, const tinygltf::Mesh& mesh, const std::string& name,
                                      GltfAccessors& accessors, bool with_attributes, bool is_own) {
  std::vector<ScenePart> parts;
  for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
    const tinygltf::Primitive& primitive = mesh.primitives[i];
    // Without positions there is nothing to show, the specification says.
    if (!primitive.attributes.contains("POSITION")) continue;
    const std::string which = mesh.primitives.size() > 1 ? fmt::format(", primitive {}", i) : "";
    parts.push_back(PrimitiveReader(scene, primitive, fmt::format("mesh \"{}\"{}", name, which), accessors)
                        .read(with_attributes));
    if (is_own && with_attributes) read_own_extras(primitive.extras, parts.back());
  }
  return parts;
}

}  // namespace tvg::cli
