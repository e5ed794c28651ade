#pragma once
#include "encoder/importers/scene_nodes.hpp"

#include <cstdint>
#include <string>
#include <vector>

struct aiAnimation;
struct aiNodeAnim;

namespace tvg::cli {

class SceneFile;

/// Values over time; times never decrease.
template <class Value>
struct Track {
  std::vector<double> times;  ///< [key], in seconds
  std::vector<Value> values;  ///< [key]
};

/// What a channel does before its first key and after its last.
enum class Extrapolation { kHold, kLinear, kRepeat };

/// The motion of one node. A track without keys keeps what the node has without the clip.
struct NodeChannel {
  std::size_t node = 0;
  Track<Eigen::Vector3d> positions;
  Track<Eigen::Quaterniond> rotations;
  Track<Eigen::Vector3d> scales;
  Extrapolation before = Extrapolation::kHold;
  Extrapolation after = Extrapolation::kHold;

  /// The node's local transform at a time in seconds.
  Transform at(double seconds) const;
};

/// Weights of the morph targets of all meshes of one name over time.
struct MorphChannel {
  std::string target;                  ///< name of a mesh, or of the node that holds it
  Track<std::vector<double>> weights;  ///< [key][morph target]
  std::size_t target_count = 0;

  /// Weights at a time in seconds, target_count values.
  void at(double seconds, std::vector<double>& weights_out) const;
};

/// One animation of a scene.
struct Clip {
  std::string name;
  std::vector<NodeChannel> nodes;
  std::vector<MorphChannel> morphs;
  double first = 0;  ///< time of the first key, in seconds, of all tracks with more than one
  double last = 0;   ///< time of their last key

  double duration() const { return last - first; }
  /// Samples at `fps` from the first key to the last, both included: where the duration is no whole number of
  /// samples, the last one is taken up to one sample late and shows the last key.
  std::uint64_t frame_count(double fps) const;
  /// Places of all nodes at a time, [node]; starts from `rest`.
  void pose(double seconds, const std::vector<Transform>& rest, std::vector<Transform>& local) const;
};

/// Reads a clip of a scene. Throws ImportError (kInvalidInput) where a time or value is not finite.
Clip read_clip(const SceneFile& file, const SceneNodes& nodes, std::size_t index);

/// The number of the clip that `wanted` names (see SceneOptions). Throws ToolError (kUsage) that lists the
/// clips where there is no such.
std::size_t find_clip(const SceneFile& file, const std::string& wanted);

}  // namespace tvg::cli
