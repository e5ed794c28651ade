#include "encoder/importers/gltf_reader.hpp"

#include "encoder/importers/gltf_clip.hpp"
#include "encoder/importers/gltf_instances.hpp"
#include "encoder/importers/gltf_materials.hpp"
#include "encoder/importers/gltf_mesh.hpp"
#include "encoder/importers/gltf_nodes.hpp"
#include "encoder/importers/gltf_uri.hpp"
#include "encoder/importers/input_file.hpp"

#include <fmt/format.h>

namespace tvg::cli {

namespace {

/// The least of a mesh that is shown, and more.
constexpr std::uint64_t kVerticesPerInstance = 16;

class GltfReader final : public SceneReader {
 public:
  GltfReader(const std::string& path, std::string bytes, GltfFileReader read_file, const GltfLimits& limits)
      : bytes_(std::move(bytes)), document_(read_gltf_document(path, bytes_)) {
    scene_.path = path;
    if (!is_read()) return;
    accessors_ = std::make_unique<GltfAccessors>(scene_.path, document_, std::move(read_file), limits);
    scene_.metadata = {{"units", "m"}, {"up", "y"}};
    scene_.metadata.insert(document_.metadata.begin(), document_.metadata.end());
    scene_.linear_colours = true;
    scene_.notes = document_.notes;
    scene_.most_vertices = limits.most_vertices(bytes_.size());
    for (std::size_t i = 0; i < model().meshes.size(); ++i) {
      const std::string& name = model().meshes[i].name;
      scene_.mesh_names.push_back(name.empty() ? fmt::format("mesh {}", i) : name);
    }
    for (const tinygltf::Animation& animation : model().animations)
      scene_.clip_names.push_back(animation.name);
    scene_.material_names = name_gltf_materials(document_);
    read_gltf_nodes(document_, scene_, nodes_);
    place_instances(limits.most_vertices(bytes_.size()) / kVerticesPerInstance);
    read_skins();
  }

  bool is_read() const { return document_.version == 2; }

  std::vector<ScenePart> read_mesh(std::size_t mesh, bool with_attributes) const override {
    return read_gltf_mesh(scene_, model().meshes[mesh], scene_.mesh_names[mesh], *accessors_, with_attributes,
                          document_.is_own);
  }
  Clip read_clip(std::size_t clip, std::vector<std::string>& /*notes*/) const override {
    return read_gltf_clip(scene_, document_, nodes_, clip, *accessors_);
  }

  std::vector<NamedData> read_data(bool embed_textures, std::vector<std::string>& notes) const override {
    return read_gltf_data(scene_.path, document_, *accessors_, embed_textures, notes);
  }

 private:
  const tinygltf::Model& model() const { return document_.model; }

  /// Each as often as its node says.
  void place_instances(std::uint64_t most) {
    std::vector<std::size_t> in_file(nodes_.place.size());
    for (std::size_t node = 0; node < in_file.size(); ++node) in_file[nodes_.place[node]] = node;
    std::vector<SceneInstance> instances;
    for (SceneInstance& instance : scene_.instances) {
      const tinygltf::Node& node = model().nodes[in_file[instance.node]];
      const std::string& name = scene_.nodes.list()[instance.node].name;
      for (const Transform& placed :
           read_gltf_instances(scene_, node, name, *accessors_, most - instances.size())) {
        instance.placed = placed;
        instances.push_back(instance);
      }
    }
    scene_.instances = std::move(instances);
  }

  /// Those that some instance has.
  void read_skins() {
    scene_.skins.resize(model().skins.size());
    for (const SceneInstance& instance : scene_.instances) {
      if (instance.skin && scene_.skins[*instance.skin].joints.empty()) read_skin(*instance.skin);
    }
  }

  void read_skin(std::size_t index) {
    const tinygltf::Skin& source = model().skins[index];
    SceneSkin& skin = scene_.skins[index];
    for (const int joint : source.joints) {
      if (joint < 0 || static_cast<std::size_t>(joint) >= nodes_.place.size()) {
        scene_.fail(fmt::format("skin {} has the joint {}, and there are {} nodes", index, joint,
                                nodes_.place.size()));
      }
      skin.joints.push_back(nodes_.place[static_cast<std::size_t>(joint)]);
    }
    skin.offsets.assign(skin.joints.size(), Transform::Identity());
    if (source.inverseBindMatrices < 0) return;
    const std::string what = fmt::format("skin {}, inverseBindMatrices", index);
    const std::vector<double> matrices = accessors_->read(source.inverseBindMatrices, 16, what);
    if (matrices.size() / 16 < skin.joints.size()) {
      scene_.fail(
          fmt::format("{} has {} matrices for {} joints", what, matrices.size() / 16, skin.joints.size()));
    }
    for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
      const Eigen::Map<const Eigen::Matrix4d> matrix(&matrices[16 * joint]);
      skin.offsets[joint].matrix().topRows<3>() = matrix.topRows<3>();
    }
  }

  std::string bytes_;
  GltfDocument document_;
  GltfNodes nodes_;
  std::unique_ptr<GltfAccessors> accessors_;
};

}  // namespace

std::unique_ptr<SceneReader> parse_gltf_scene(const std::string& path, std::string bytes,
                                              GltfFileReader read_file, const GltfLimits& limits) {
  auto reader = std::make_unique<GltfReader>(path, std::move(bytes), std::move(read_file), limits);
  return reader->is_read() ? std::move(reader) : nullptr;
}

std::unique_ptr<SceneReader> read_gltf_scene(const std::string& path) {
  std::string bytes;
  read_file(path, bytes);
  return parse_gltf_scene(path, std::move(bytes),
                          [path](const std::string& uri) { return read_beside(path, uri); });
}

}  // namespace tvg::cli
