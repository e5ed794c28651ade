#include "encoder/importers/assimp_clip.hpp"

#include "encoder/importers/collada_keys.hpp"
#include "tool/mesh_format.hpp"

#include <algorithm>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

/// What assimp's documentation asks readers to assume where a format says nothing.
constexpr double kDefaultTicksPerSecond = 25;

/// What DirectX takes where a file has no AnimTicksPerSecond.
constexpr double kDirectXTicksPerSecond = 4800;

constexpr unsigned kMostMorphTargets = 1u << 16;

/// "Face*0" for "Face": assimp appends a number to the channels of FBX.
std::string without_number(const std::string& name) {
  const std::size_t star = name.rfind('*');
  const bool numbered =
      star != std::string::npos && name.find_first_not_of("0123456789", star + 1) == std::string::npos;
  return numbered ? name.substr(0, star) : name;
}

Extrapolation extrapolation(aiAnimBehaviour behaviour) {
  switch (behaviour) {
    case aiAnimBehaviour_LINEAR:
      return Extrapolation::kLinear;
    case aiAnimBehaviour_REPEAT:
      return Extrapolation::kRepeat;
    default:
      return Extrapolation::kHold;
  }
}

Eigen::Vector3d to_vector(const aiVector3D& value) {
  return {double{value.x}, double{value.y}, double{value.z}};
}

Eigen::Quaterniond to_rotation(const aiQuaternion& value) {
  return {double{value.w}, double{value.x}, double{value.y}, double{value.z}};
}

void append(const aiVector3D& value, std::vector<double>& out) {
  out.insert(out.end(), {double{value.x}, double{value.y}, double{value.z}});
}

void append(const aiQuaternion& value, std::vector<double>& out) {
  out.insert(out.end(), {double{value.x}, double{value.y}, double{value.z}, double{value.w}});
}

Placement rest_of(const aiMatrix4x4& matrix) {
  aiVector3D position;
  aiVector3D scale;
  aiQuaternion rotation;
  matrix.Decompose(scale, rotation, position);
  Placement rest{to_vector(position), to_rotation(rotation), to_vector(scale)};
  const double norm = rest.rotation.norm();
  if (std::isfinite(norm) && norm >= 1e-12) {
    rest.rotation.normalize();
  } else {
    rest.rotation.setIdentity();
  }
  return rest;
}

class ClipReader {
 public:
  ClipReader(const Scene& scene, const AssimpNames& names, const aiAnimation& animation)
      : scene_(scene), names_(names), animation_(animation) {
    clip_.name = animation.mName.C_Str();
  }

  Clip read(std::vector<std::string>& notes) {
    read_rate(notes);
    for (unsigned i = 0; i < animation_.mNumChannels; ++i) {
      if (animation_.mChannels[i] != nullptr) read_node_channel(*animation_.mChannels[i]);
    }
    for (unsigned i = 0; i < animation_.mNumMorphMeshChannels; ++i) {
      if (animation_.mMorphMeshChannels[i] != nullptr) read_morph_channel(*animation_.mMorphMeshChannels[i]);
    }
    if (has_suffix(scene_.path, ".dae")) restore_collada_keys(scene_.path, clip_, notes);
    clip_.finish(scene_.path, scene_.nodes);
    return std::move(clip_);
  }

 private:
  void read_rate(std::vector<std::string>& notes) {
    const double rate = animation_.mTicksPerSecond;
    if (std::isfinite(rate) && rate > 0) {
      ticks_per_second_ = rate;
      return;
    }
    const bool direct_x = has_suffix(scene_.path, ".x");
    ticks_per_second_ = direct_x ? kDirectXTicksPerSecond : kDefaultTicksPerSecond;
    notes.push_back(
        fmt::format("{}: it does not say how many ticks of its clips a second has: {} are taken{}",
                    scene_.path, ticks_per_second_, direct_x ? ", as DirectX does" : ""));
  }

  template <class Key>
  void read_track(const Key* keys, unsigned count, Track& track) {
    for (unsigned i = 0; keys != nullptr && i < count; ++i) {
      track.times.push_back(keys[i].mTime / ticks_per_second_);
      append(keys[i].mValue, track.values);
    }
  }

  void read_node_channel(const aiNodeAnim& source) {
    const std::int32_t node = names_.node(source.mNodeName.C_Str());
    // Files name cameras, lights or IK targets that were not exported.
    if (node < 0) return;
    NodeChannel channel;
    channel.node = static_cast<std::size_t>(node);
    read_track(source.mPositionKeys, source.mNumPositionKeys, channel.positions);
    read_track(source.mRotationKeys, source.mNumRotationKeys, channel.rotations);
    read_track(source.mScalingKeys, source.mNumScalingKeys, channel.scales);
    channel.before = extrapolation(source.mPreState);
    channel.after = extrapolation(source.mPostState);
    channel.rest = rest_of(names_.nodes[channel.node]->mTransformation);
    clip_.nodes.push_back(std::move(channel));
  }

  void read_morph_channel(const aiMeshMorphAnim& source) {
    MorphChannel channel;
    find_targets(source.mName.C_Str(), channel);
    std::vector<std::vector<double>> keys;
    for (unsigned i = 0; source.mKeys != nullptr && i < source.mNumKeys; ++i) {
      const aiMeshMorphKey& key = source.mKeys[i];
      std::vector<double> weights;
      for (unsigned entry = 0; entry < key.mNumValuesAndWeights; ++entry) {
        const unsigned target = key.mValues[entry];
        if (target > kMostMorphTargets) {
          scene_.fail(fmt::format("clip \"{}\" has a key of morph target {} of \"{}\"", clip_.name, target,
                                  source.mName.C_Str()));
        }
        if (target >= weights.size()) weights.resize(target + std::size_t{1});
        weights[target] = key.mWeights[entry];
      }
      channel.weights.width = std::max(channel.weights.width, weights.size());
      channel.weights.times.push_back(key.mTime / ticks_per_second_);
      keys.push_back(std::move(weights));
    }
    if (keys.empty()) return;
    for (std::vector<double>& weights : keys) {
      weights.resize(channel.weights.width);
      channel.weights.values.insert(channel.weights.values.end(), weights.begin(), weights.end());
    }
    clip_.morphs.push_back(std::move(channel));
  }

  /// assimp names a mesh, or the node that holds it.
  void find_targets(const std::string& name, MorphChannel& channel) const {
    const std::string plain = without_number(name);
    for (std::size_t node = 0; node < scene_.nodes.list().size(); ++node) {
      const std::string& of_node = scene_.nodes.list()[node].name;
      if (of_node == name || of_node == plain) channel.nodes.push_back(node);
    }
    for (std::size_t mesh = 0; mesh < scene_.mesh_names.size(); ++mesh) {
      const std::string& of_mesh = scene_.mesh_names[mesh];
      if (of_mesh == name || of_mesh == plain) channel.meshes.push_back(mesh);
    }
  }

  const Scene& scene_;
  const AssimpNames& names_;
  const aiAnimation& animation_;
  double ticks_per_second_ = kDefaultTicksPerSecond;
  Clip clip_;
};

}  // namespace

Clip read_assimp_clip(const Scene& scene, const AssimpNames& names, const aiAnimation& animation,
                      std::vector<std::string>& notes) {
  return ClipReader(scene, names, animation).read(notes);
}

}  // namespace tvg::cli
