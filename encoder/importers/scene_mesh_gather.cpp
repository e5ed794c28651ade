#include "encoder/importers/scene_file.hpp"
#include "encoder/importers/scene_mesh.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>

namespace tvg::cli {

namespace {

constexpr std::size_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

bool is_finite(const aiVector3D& value) {
  return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
}

Eigen::Vector3d to_point(const aiVector3D& value) {
  return {double{value.x}, double{value.y}, double{value.z}};
}

/// "Face*0" for "Face": assimp appends a number to the channels of FBX.
std::string without_number(const std::string& name) {
  const std::size_t star = name.rfind('*');
  const bool numbered =
      star != std::string::npos && name.find_first_not_of("0123456789", star + 1) == std::string::npos;
  return numbered ? name.substr(0, star) : name;
}

class Gatherer {
 public:
  Gatherer(const SceneFile& file, const SceneNodes& nodes, const Clip& clip,
           const std::vector<std::string>& wanted)
      : file_(file), scene_(file.scene()), nodes_(nodes), clip_(clip), wanted_(wanted) {
    result_.influence_begin = {0};
    result_.morph_begin = {0};
  }

  SceneMesh gather() {
    for (std::size_t node = 0; node < nodes_.list().size(); ++node) {
      const aiNode& source = *nodes_.list()[node].source;
      for (unsigned i = 0; i < source.mNumMeshes; ++i) {
        if (source.mMeshes[i] >= scene_.mNumMeshes) {
          file_.fail(fmt::format("node \"{}\" holds mesh {} of {}", source.mName.C_Str(), source.mMeshes[i],
                                 scene_.mNumMeshes));
        }
        take(source.mMeshes[i], node);
      }
    }
    check_names();
    if (result_.mesh.faces.empty()) {
      file_.fail(scene_.mNumMeshes == 0 ? "it holds no mesh to encode"
                                        : "its meshes have no faces to encode");
    }
    result_.mesh.vertex_count = static_cast<std::uint32_t>(result_.positions.size());
    return std::move(result_);
  }

 private:
  bool is_wanted(const std::string& mesh, const std::string& node) {
    names_.insert(mesh);
    names_.insert(node);
    if (wanted_.empty()) return true;
    bool found = false;
    for (const std::string& name : wanted_) {
      if (name != mesh && name != node) continue;
      found_.insert(name);
      found = true;
    }
    return found;
  }

  void check_names() const {
    for (const std::string& name : wanted_) {
      if (found_.contains(name)) continue;
      throw ToolError(ExitStatus::kUsage, fmt::format("--mesh {}: {} has no mesh of that name; it has \"{}\"",
                                                      name, file_.path(), fmt::join(names_, "\", \"")));
    }
  }

  void take(unsigned index, std::size_t node) {
    if (scene_.mMeshes[index] == nullptr) file_.fail(fmt::format("mesh {} is missing", index));
    const aiMesh& mesh = *scene_.mMeshes[index];
    const std::string mesh_name = mesh.mName.C_Str();
    if (!is_wanted(mesh_name, nodes_.list()[node].name)) return;
    if (mesh.mNumBones > 0 && !skinned_.insert(index).second) return;
    const std::size_t first = result_.positions.size();
    if (mesh.mVertices == nullptr || mesh.mNumVertices == 0) return;
    if (mesh.mNumVertices > kMostVertices - first) file_.fail("its meshes have more vertices than 2^32");
    if (!take_faces(mesh, first)) return;
    ++result_.parts;
    take_positions(mesh, node);
    take_influences(mesh, node);
  }

  bool take_faces(const aiMesh& mesh, std::size_t first) {
    const std::size_t faces_before = result_.mesh.faces.size();
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& source = mesh.mFaces[i];
      if (source.mNumIndices != 3 || source.mIndices == nullptr) {
        ++result_.left_out;
        continue;
      }
      Face face;
      for (unsigned corner = 0; corner < 3; ++corner) {
        if (source.mIndices[corner] >= mesh.mNumVertices) {
          file_.fail(fmt::format("mesh \"{}\", face {} names vertex {} of {}", mesh.mName.C_Str(), i,
                                 source.mIndices[corner], mesh.mNumVertices));
        }
        face[corner] = static_cast<std::uint32_t>(first + source.mIndices[corner]);
      }
      result_.mesh.faces.push_back(face);
    }
    return result_.mesh.faces.size() > faces_before;
  }

  /// The slots of the channel that moves the mesh's morph targets; nothing where none does.
  const MorphSlots* slots_of(const aiMesh& mesh, const std::string& node) {
    const std::string mesh_name = mesh.mName.C_Str();
    for (std::size_t channel = 0; channel < clip_.morphs.size(); ++channel) {
      const std::string& target = clip_.morphs[channel].target;
      const std::string plain = without_number(target);
      if (target != node && target != mesh_name && plain != node && plain != mesh_name) continue;
      for (const MorphSlots& slots : result_.slots) {
        if (slots.channel == channel) return &slots;
      }
      const std::size_t count = clip_.morphs[channel].target_count;
      result_.slots.push_back({channel, result_.slot_count, count});
      result_.slot_count += count;
      return &result_.slots.back();
    }
    return nullptr;
  }

  void take_positions(const aiMesh& mesh, std::size_t node) {
    for (unsigned target = 0; target < mesh.mNumAnimMeshes; ++target) {
      const aiAnimMesh* morph = mesh.mAnimMeshes[target];
      if (morph == nullptr || (morph->mVertices != nullptr && morph->mNumVertices != mesh.mNumVertices)) {
        file_.fail(fmt::format("mesh \"{}\", morph target {} has {} vertices, the mesh has {}",
                               mesh.mName.C_Str(), target, morph == nullptr ? 0 : morph->mNumVertices,
                               mesh.mNumVertices));
      }
    }
    const MorphSlots* slots = mesh.mNumAnimMeshes > 0 ? slots_of(mesh, nodes_.list()[node].name) : nullptr;
    for (unsigned vertex = 0; vertex < mesh.mNumVertices; ++vertex) {
      if (!is_finite(mesh.mVertices[vertex]))
        fail_vertex(mesh, vertex, "a coordinate that is NaN or infinite");
      const Eigen::Vector3d base = to_point(mesh.mVertices[vertex]);
      Eigen::Vector3d position = base;
      for (unsigned target = 0; target < mesh.mNumAnimMeshes; ++target) {
        const aiAnimMesh& morph = *mesh.mAnimMeshes[target];
        if (morph.mVertices == nullptr) continue;
        if (!is_finite(morph.mVertices[vertex]))
          fail_vertex(mesh, vertex, "a morph target that is NaN or infinite");
        const Eigen::Vector3d delta = to_point(morph.mVertices[vertex]) - base;
        if (delta.isZero(0)) continue;
        if (slots == nullptr) {
          position += double{morph.mWeight} * delta;
        } else if (target < slots->count) {
          result_.morphs.push_back({static_cast<std::uint32_t>(slots->first + target), delta});
        }
      }
      result_.positions.push_back(position);
      result_.morph_begin.push_back(result_.morphs.size());
    }
  }

  /// One carrier for each node and offset, so that seams between materials can be joined.
  std::uint32_t carrier(std::size_t node, const Transform& offset, bool is_bone) {
    std::vector<double> key = {static_cast<double>(node), is_bone ? 1.0 : 0.0};
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 4; ++column) key.push_back(offset.matrix()(row, column));
    }
    const auto [entry, is_new] =
        carriers_.emplace(std::move(key), static_cast<std::uint32_t>(result_.carriers.size()));
    if (is_new) result_.carriers.push_back({node, offset, is_bone});
    return entry->second;
  }

  std::uint32_t bone_carrier(const aiMesh& mesh, const aiBone& bone) {
    const std::int32_t node = nodes_.find(bone.mName.C_Str());
    if (node < 0) {
      file_.fail(fmt::format("mesh \"{}\" is bound to the bone \"{}\", which is not among the nodes",
                             mesh.mName.C_Str(), bone.mName.C_Str()));
    }
    const Transform offset = to_transform(bone.mOffsetMatrix);
    if (!offset.matrix().allFinite()) {
      file_.fail(fmt::format("mesh \"{}\": the offset of bone \"{}\" is not finite", mesh.mName.C_Str(),
                             bone.mName.C_Str()));
    }
    return carrier(static_cast<std::size_t>(node), offset, true);
  }

  void take_influences(const aiMesh& mesh, std::size_t node) {
    std::vector<std::vector<Influence>> of_vertex(mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
      if (mesh.mBones[i] == nullptr || mesh.mBones[i]->mWeights == nullptr) continue;
      const aiBone& bone = *mesh.mBones[i];
      const std::uint32_t moved_by = bone_carrier(mesh, bone);
      for (unsigned entry = 0; entry < bone.mNumWeights; ++entry) {
        const aiVertexWeight& weight = bone.mWeights[entry];
        if (weight.mVertexId >= mesh.mNumVertices) {
          file_.fail(fmt::format("mesh \"{}\", bone \"{}\" moves vertex {} of {}", mesh.mName.C_Str(),
                                 bone.mName.C_Str(), weight.mVertexId, mesh.mNumVertices));
        }
        if (!std::isfinite(weight.mWeight))
          fail_vertex(mesh, weight.mVertexId, "a weight that is NaN or infinite");
        if (weight.mWeight > 0) of_vertex[weight.mVertexId].push_back({moved_by, double{weight.mWeight}});
      }
    }
    for (std::vector<Influence>& influences : of_vertex) {
      normalize(influences);
      if (influences.empty()) influences.push_back({carrier(node, Transform::Identity(), false), 1});
      result_.influences.insert(result_.influences.end(), influences.begin(), influences.end());
      result_.influence_begin.push_back(result_.influences.size());
    }
  }

  /// In order of carrier, each once, summing to 1; empty where the weights are too small to tell.
  static void normalize(std::vector<Influence>& influences) {
    std::stable_sort(influences.begin(), influences.end(),
                     [](const Influence& a, const Influence& b) { return a.carrier < b.carrier; });
    std::size_t kept = 0;
    double sum = 0;
    for (const Influence& influence : influences) {
      sum += influence.weight;
      if (kept > 0 && influences[kept - 1].carrier == influence.carrier) {
        influences[kept - 1].weight += influence.weight;
      } else {
        influences[kept++] = influence;
      }
    }
    influences.resize(sum > 1e-12 ? kept : 0);
    for (Influence& influence : influences) influence.weight /= sum;
  }

  [[noreturn]] void fail_vertex(const aiMesh& mesh, unsigned vertex, const char* what) const {
    file_.fail(fmt::format("mesh \"{}\", vertex {} has {}", mesh.mName.C_Str(), vertex, what));
  }

  const SceneFile& file_;
  const aiScene& scene_;
  const SceneNodes& nodes_;
  const Clip& clip_;
  const std::vector<std::string>& wanted_;
  SceneMesh result_;
  std::set<unsigned> skinned_;                             // meshes with bones that have been taken
  std::map<std::vector<double>, std::uint32_t> carriers_;  // by node and offset
  std::set<std::string> names_, found_;
};

}  // namespace

SceneMesh gather_meshes(const SceneFile& file, const SceneNodes& nodes, const Clip& clip,
                        const std::vector<std::string>& wanted) {
  return Gatherer(file, nodes, clip, wanted).gather();
}

}  // namespace tvg::cli
