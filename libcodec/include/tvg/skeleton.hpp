#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tvg {

/// Joints that move a mesh. Their places in a frame are [joint][xyz], in the mesh's units.
struct Skeleton {
  std::vector<std::string> joint_names;  ///< [joint]
  std::vector<std::int32_t> parents;     ///< [joint]: index of the parent, smaller than its own; -1: a root
  std::vector<std::uint32_t> heaviest_joint;  ///< [vertex]: by skin weights; empty where there are none

  bool empty() const { return joint_names.empty(); }
  bool operator==(const Skeleton&) const = default;
};

/// A skeleton over time, all in memory.
struct JointTracks {
  Skeleton skeleton;
  std::vector<std::vector<float>> frames;  ///< [frame][joint][xyz]
};

}  // namespace tvg
