#pragma once
#include "encoder/importers/scene_nodes.hpp"
#include "encoder/importers/scene_track.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tvg::cli {

/// Where a node stands in its parent's space: scaled, then turned, then moved.
struct Placement {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();

  Transform transform() const;
};

/// The motion of one node. Where a track has no keys the node keeps what it has without the clip.
struct NodeChannel {
  std::size_t node = 0;
  Placement rest;
  Track positions{3};
  Track rotations{4, true};
  Track scales{3};
  Extrapolation before = Extrapolation::kHold;
  Extrapolation after = Extrapolation::kHold;

  /// The node's local transform at a time in seconds.
  Transform at(double seconds) const;
};

/// Weights of morph targets over time, of the meshes that any of `nodes` holds and of `meshes`.
struct MorphChannel {
  std::vector<std::size_t> nodes;
  std::vector<std::size_t> meshes;
  Track weights;  ///< [key][morph target]
};

/// One animation of a scene.
struct Clip {
  std::string name;
  std::vector<NodeChannel> nodes;
  std::vector<MorphChannel> morphs;
  /// Of a clip that `tvg decode` wrote: when its frames are, in seconds. Else empty.
  std::vector<double> frame_times;
  double first = 0;  ///< time of the first key, in seconds, of all tracks with more than one
  double last = 0;   ///< time of their last key

  double duration() const { return last - first; }
  /// Puts keys in order and says which time they span. Throws ImportError (kInvalidInput) that names `file`
  /// where a time or a value is not finite or a rotation has no length.
  void finish(const std::string& file, const SceneNodes& scene_nodes);
  /// Samples at `fps` from the first key to the last, both included: where the duration is no whole number of
  /// samples, the last one is taken up to one sample late and shows the last key.
  std::uint64_t frame_count(double fps) const;
  /// The time that such a sample shows, in seconds.
  double time_of(std::uint64_t frame, double fps) const;
  /// Places of all nodes at a time, [node]; starts from `rest`.
  void pose(double seconds, const std::vector<Transform>& rest, std::vector<Transform>& local) const;
};

}  // namespace tvg::cli
