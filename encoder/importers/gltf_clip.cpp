#include "encoder/importers/gltf_clip.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace tvg::cli {

namespace {

class ClipReader {
 public:
  ClipReader(const Scene& scene, const GltfDocument& document, const GltfNodes& nodes, std::size_t index,
             GltfAccessors& accessors)
      : scene_(scene),
        model_(document.model),
        nodes_(nodes),
        animation_(model_.animations[index]),
        accessors_(accessors),
        is_own_(document.is_own) {
    clip_.name = scene.clip_names[index];
  }

  Clip read() {
    for (const tinygltf::AnimationChannel& channel : animation_.channels) {
      // A channel without a node is for extensions.
      if (channel.target_node < 0) continue;
      if (static_cast<std::size_t>(channel.target_node) >= nodes_.place.size()) {
        fail(fmt::format("moves node {} of {}", channel.target_node, nodes_.place.size()));
      }
      read_channel(channel, static_cast<std::size_t>(channel.target_node));
    }
    clip_.finish(scene_.path, scene_.nodes);
    if (is_own_) clip_.frame_times = key_times();
    return std::move(clip_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    scene_.fail(fmt::format("clip \"{}\" {}", clip_.name, what));
  }

  /// Every frame of our own files has a key, of its weight or of the node that shows its mesh.
  std::vector<double> key_times() const {
    std::set<double> times;
    for (const MorphChannel& channel : clip_.morphs)
      times.insert(channel.weights.times.begin(), channel.weights.times.end());
    for (const NodeChannel& channel : clip_.nodes)
      times.insert(channel.scales.times.begin(), channel.scales.times.end());
    return {times.begin(), times.end()};
  }

  void read_channel(const tinygltf::AnimationChannel& channel, std::size_t node) {
    if (channel.target_path == "weights") {
      read_morphs(channel, node);
    } else if (channel.target_path == "translation") {
      read_track(channel, node_channel(node).positions);
    } else if (channel.target_path == "rotation") {
      read_track(channel, node_channel(node).rotations);
    } else if (channel.target_path == "scale") {
      read_track(channel, node_channel(node).scales);
    }
  }

  NodeChannel& node_channel(std::size_t node) {
    const auto [entry, is_new] = channel_of_.emplace(node, clip_.nodes.size());
    if (is_new) {
      NodeChannel& channel = clip_.nodes.emplace_back();
      channel.node = nodes_.place[node];
      channel.rest = nodes_.rest[node];
    }
    return clip_.nodes[entry->second];
  }

  void read_morphs(const tinygltf::AnimationChannel& channel, std::size_t node) {
    const int mesh = model_.nodes[node].mesh;
    if (mesh < 0 || static_cast<std::size_t>(mesh) >= model_.meshes.size()) return;
    MorphChannel morph;
    morph.nodes = {nodes_.place[node]};
    for (const tinygltf::Primitive& primitive : model_.meshes[static_cast<std::size_t>(mesh)].primitives) {
      morph.weights.width = std::max(morph.weights.width, primitive.targets.size());
    }
    if (morph.weights.width == 0) return;
    read_track(channel, morph.weights);
    if (!morph.weights.empty()) clip_.morphs.push_back(std::move(morph));
  }

  Interpolation interpolation_of(const tinygltf::AnimationSampler& sampler) const {
    if (sampler.interpolation.empty() || sampler.interpolation == "LINEAR") return Interpolation::kLinear;
    if (sampler.interpolation == "STEP") return Interpolation::kStep;
    if (sampler.interpolation == "CUBICSPLINE") return Interpolation::kCubic;
    fail(fmt::format("has the interpolation \"{}\", which glTF does not know", sampler.interpolation));
  }

  /// One channel for each path of a node; the first where there are more.
  void read_track(const tinygltf::AnimationChannel& channel, Track& track) {
    if (!track.empty()) return;
    if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation_.samplers.size()) {
      fail(fmt::format("has a channel of sampler {}, and there are {}", channel.sampler,
                       animation_.samplers.size()));
    }
    const tinygltf::AnimationSampler& sampler =
        animation_.samplers[static_cast<std::size_t>(channel.sampler)];
    track.interpolation = interpolation_of(sampler);
    const std::string what =
        fmt::format("clip \"{}\", {} of node \"{}\"", clip_.name, channel.target_path,
                    scene_.nodes.list()[nodes_.place[static_cast<std::size_t>(channel.target_node)]].name);
    track.times = accessors_.read(sampler.input, 1, what);
    const bool is_morph = channel.target_path == "weights";
    track.values = accessors_.read(sampler.output, is_morph ? 1 : track.width, what);
    if (track.values.size() != track.times.size() * track.key_size()) {
      scene_.fail(fmt::format("{} has {} keys and {} numbers, where each key has {}", what,
                              track.times.size(), track.values.size(), track.key_size()));
    }
  }

  const Scene& scene_;
  const tinygltf::Model& model_;
  const GltfNodes& nodes_;
  const tinygltf::Animation& animation_;
  GltfAccessors& accessors_;
  bool is_own_;
  Clip clip_;
  std::map<std::size_t, std::size_t> channel_of_;  // of the clip, by node
};

}  // namespace

Clip read_gltf_clip(const Scene& scene, const GltfDocument& document, const GltfNodes& nodes,
                    std::size_t index, GltfAccessors& accessors) {
  return ClipReader(scene, document, nodes, index, accessors).read();
}

}  // namespace tvg::cli
