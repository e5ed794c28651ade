#include "encoder/importers/assimp_reader.hpp"

#include "encoder/importers/assimp_attributes.hpp"
#include "encoder/importers/assimp_clip.hpp"
#include "encoder/importers/assimp_import.hpp"
#include "encoder/importers/assimp_materials.hpp"
#include "encoder/importers/assimp_polygons.hpp"
#include "tool/mesh_format.hpp"

#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>
#include <unordered_map>

namespace tvg::cli {

namespace {

Transform to_transform(const aiMatrix4x4& matrix) {
  Transform transform = Transform::Identity();
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      transform.matrix()(row, column) = double{matrix[row][column]};
    }
  }
  return transform;
}

Eigen::Vector3d to_point(const aiVector3D& value) {
  return {double{value.x}, double{value.y}, double{value.z}};
}

/// FBX says centimetres per unit.
std::string unit_of_centimetres(double centimetres) {
  struct Unit {
    double centimetres;
    const char* name;
  };
  for (const Unit& unit : {Unit{0.1, "mm"}, Unit{1, "cm"}, Unit{100, "m"}, Unit{100000, "km"},
                           Unit{2.54, "in"}, Unit{30.48, "ft"}}) {
    if (std::abs(centimetres - unit.centimetres) <= 1e-6 * unit.centimetres) return unit.name;
  }
  return "";
}

Metadata fbx_metadata(const aiScene& scene) {
  Metadata metadata;
  if (scene.mMetaData == nullptr) return metadata;
  double scale = 0;
  float single_scale = 0;
  if (!scene.mMetaData->Get("UnitScaleFactor", scale) &&
      scene.mMetaData->Get("UnitScaleFactor", single_scale)) {
    scale = double{single_scale};
  }
  if (const std::string unit = unit_of_centimetres(scale); !unit.empty()) metadata.emplace("units", unit);
  std::int32_t up = -1;
  if (scene.mMetaData->Get("UpAxis", up) && (up == 1 || up == 2)) metadata.emplace("up", up == 1 ? "y" : "z");
  return metadata;
}

class AssimpReader final : public SceneReader {
 public:
  AssimpReader(const std::string& path, std::optional<std::uint32_t> keyframe);

  std::vector<ScenePart> read_mesh(std::size_t mesh, bool with_attributes) const override;
  std::vector<NamedData> read_data(bool embed_textures, std::vector<std::string>& notes) const override {
    return read_assimp_data(scene_.path, *import_, scene_.material_names, embed_textures, notes);
  }
  Clip read_clip(std::size_t clip, std::vector<std::string>& notes) const override {
    return read_assimp_clip(scene_, names_, *import_->mAnimations[clip], notes);
  }

 private:
  void read_nodes();
  void read_meshes();
  void read_instances();
  SceneSkin read_skin(const aiMesh& mesh) const;
  void read_influences(const aiMesh& mesh, ScenePart& part) const;
  void read_targets(const aiMesh& mesh, ScenePart& part) const;
  Metadata metadata() const;

  std::unique_ptr<AssimpImport> holder_;
  const aiScene* import_ = nullptr;
  AssimpNames names_;
  std::unordered_map<std::string, std::int32_t> by_name_;
  std::vector<std::optional<std::size_t>> skin_of_;  // [mesh]
};

AssimpReader::AssimpReader(const std::string& path, std::optional<std::uint32_t> keyframe) {
  scene_.path = path;
  holder_ = std::make_unique<AssimpImport>(scene_, keyframe);
  import_ = &**holder_;
  read_nodes();
  read_meshes();
  read_instances();
  scene_.material_names = name_assimp_materials(*import_);
  for (unsigned i = 0; i < import_->mNumAnimations; ++i) {
    scene_.clip_names.emplace_back(import_->mAnimations[i]->mName.C_Str());
  }
  scene_.metadata = metadata();
}

void AssimpReader::read_nodes() {
  struct Pending {
    const aiNode* node;
    std::int32_t parent;
  };
  std::vector<SceneNode> nodes;
  std::vector<Pending> pending = {{import_->mRootNode, -1}};
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    if (next.node == nullptr) continue;
    const auto index = static_cast<std::int32_t>(nodes.size());
    nodes.push_back({next.node->mName.C_Str(), next.parent, to_transform(next.node->mTransformation)});
    names_.nodes.push_back(next.node);
    by_name_.emplace(nodes.back().name, index);
    for (unsigned child = next.node->mNumChildren; child > 0; --child) {
      pending.push_back({next.node->mChildren[child - 1], index});
    }
  }
  scene_.nodes = SceneNodes(std::move(nodes));
  names_.node = [this](const std::string& name) {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? -1 : found->second;
  };
}

void AssimpReader::read_meshes() {
  for (unsigned i = 0; i < import_->mNumMeshes; ++i) {
    if (import_->mMeshes[i] == nullptr) scene_.fail(fmt::format("mesh {} is missing", i));
    const aiMesh& mesh = *import_->mMeshes[i];
    scene_.mesh_names.emplace_back(mesh.mName.C_Str());
    skin_of_.emplace_back();
    if (mesh.mNumBones == 0) continue;
    skin_of_.back() = scene_.skins.size();
    scene_.skins.push_back(read_skin(mesh));
  }
}

/// Bones without weights are none.
bool has_weights(const aiMesh& mesh, unsigned bone) {
  return mesh.mBones[bone] != nullptr && mesh.mBones[bone]->mWeights != nullptr;
}

SceneSkin AssimpReader::read_skin(const aiMesh& mesh) const {
  SceneSkin skin;
  for (unsigned i = 0; i < mesh.mNumBones; ++i) {
    if (!has_weights(mesh, i)) continue;
    const aiBone& bone = *mesh.mBones[i];
    const std::int32_t node = names_.node(bone.mName.C_Str());
    if (node < 0) {
      scene_.fail(fmt::format("mesh \"{}\" is bound to the bone \"{}\", which is not among the nodes",
                              mesh.mName.C_Str(), bone.mName.C_Str()));
    }
    skin.joints.push_back(static_cast<std::size_t>(node));
    skin.offsets.push_back(to_transform(bone.mOffsetMatrix));
  }
  return skin;
}

void AssimpReader::read_instances() {
  for (std::size_t node = 0; node < names_.nodes.size(); ++node) {
    const aiNode& source = *names_.nodes[node];
    for (unsigned i = 0; i < source.mNumMeshes; ++i) {
      const unsigned index = source.mMeshes[i];
      if (index >= import_->mNumMeshes) {
        scene_.fail(
            fmt::format("node \"{}\" holds mesh {} of {}", source.mName.C_Str(), index, import_->mNumMeshes));
      }
      const aiMesh& mesh = *import_->mMeshes[index];
      SceneInstance instance{.node = node, .mesh = index, .skin = skin_of_[index]};
      for (unsigned target = 0; target < mesh.mNumAnimMeshes; ++target) {
        const aiAnimMesh* morph = mesh.mAnimMeshes[target];
        instance.weights.push_back(morph == nullptr ? 0 : double{morph->mWeight});
      }
      scene_.instances.push_back(std::move(instance));
    }
  }
}

void AssimpReader::read_influences(const aiMesh& mesh, ScenePart& part) const {
  part.weights.resize(mesh.mNumVertices);
  std::uint32_t joint = 0;
  for (unsigned i = 0; i < mesh.mNumBones; ++i) {
    if (!has_weights(mesh, i)) continue;
    const aiBone& bone = *mesh.mBones[i];
    for (unsigned entry = 0; entry < bone.mNumWeights; ++entry) {
      const aiVertexWeight& weight = bone.mWeights[entry];
      if (weight.mVertexId >= mesh.mNumVertices) {
        scene_.fail(fmt::format("mesh \"{}\", bone \"{}\" moves vertex {} of {}", mesh.mName.C_Str(),
                                bone.mName.C_Str(), weight.mVertexId, mesh.mNumVertices));
      }
      part.weights[weight.mVertexId].push_back({joint, double{weight.mWeight}});
    }
    ++joint;
  }
}

void AssimpReader::read_targets(const aiMesh& mesh, ScenePart& part) const {
  for (unsigned target = 0; target < mesh.mNumAnimMeshes; ++target) {
    const aiAnimMesh* morph = mesh.mAnimMeshes[target];
    if (morph == nullptr || (morph->mVertices != nullptr && morph->mNumVertices != mesh.mNumVertices)) {
      scene_.fail(fmt::format("mesh \"{}\", morph target {} has {} vertices, the mesh has {}",
                              mesh.mName.C_Str(), target, morph == nullptr ? 0 : morph->mNumVertices,
                              mesh.mNumVertices));
    }
    std::vector<VertexShift>& shifts = part.targets.emplace_back();
    if (morph->mVertices == nullptr) continue;
    for (unsigned vertex = 0; vertex < mesh.mNumVertices; ++vertex) {
      const Eigen::Vector3d delta = to_point(morph->mVertices[vertex]) - part.positions[vertex];
      if (!delta.isZero(0)) shifts.push_back({vertex, delta});
    }
  }
}

std::vector<ScenePart> AssimpReader::read_mesh(std::size_t index, bool with_attributes) const {
  const aiMesh& mesh = *import_->mMeshes[index];
  std::vector<ScenePart> parts(1);
  ScenePart& part = parts.front();
  if (mesh.mVertices == nullptr) return parts;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) part.positions.push_back(to_point(mesh.mVertices[i]));
  read_assimp_faces(mesh, part);
  if (mesh.mNumBones > 0) read_influences(mesh, part);
  read_targets(mesh, part);
  if (!with_attributes) return parts;
  read_assimp_attributes(mesh, part);
  if (mesh.mMaterialIndex < scene_.material_names.size()) part.material = mesh.mMaterialIndex;
  return parts;
}

Metadata AssimpReader::metadata() const {
  if (has_suffix(scene_.path, ".fbx")) return fbx_metadata(*import_);
  // assimp turns and scales COLLADA to what glTF prescribes.
  if (has_suffix(scene_.path, ".dae") || has_suffix(scene_.path, ".gltf") ||
      has_suffix(scene_.path, ".glb")) {
    return {{"units", "m"}, {"up", "y"}};
  }
  return {};
}

}  // namespace

std::unique_ptr<SceneReader> read_assimp_scene(const std::string& path,
                                               std::optional<std::uint32_t> keyframe) {
  return std::make_unique<AssimpReader>(path, keyframe);
}

}  // namespace tvg::cli
