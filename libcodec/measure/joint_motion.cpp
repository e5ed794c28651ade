#include "measure/joint_motion.hpp"

#include "base/errors.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numbers>
#include <string>

namespace tvg {

namespace {

using Eigen::Vector3d;

constexpr double kShareOfStrongest = 0.25;
constexpr double kLeastDegreesPerFrame = 0.1;

Vector3d point(std::span<const float> positions, std::size_t index) {
  return Eigen::Map<const Eigen::Vector3f>(positions.data() + 3 * index).cast<double>();
}

/// The joints at the far ends of the segments that meet at each joint: its parent first, then its children.
std::vector<std::vector<std::size_t>> neighbours(const Skeleton& skeleton) {
  std::vector<std::vector<std::size_t>> result(skeleton.parents.size());
  for (std::size_t j = 0; j < result.size(); ++j) {
    if (skeleton.parents[j] < 0) continue;
    const auto parent = static_cast<std::size_t>(skeleton.parents[j]);
    result[j].insert(result[j].begin(), parent);
    result[parent].push_back(j);
  }
  return result;
}

/// Degrees between two segments; not a number where one has no length.
double angle_between(const Vector3d& a, const Vector3d& b) {
  if (a.isZero(0) || b.isZero(0)) return std::numeric_limits<double>::quiet_NaN();
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

/// Angles of every pair of segments at a joint in one frame.
void append_angles(std::span<const float> joints, std::size_t joint, const std::vector<std::size_t>& ends,
                   std::vector<double>& angles) {
  for (std::size_t a = 0; a < ends.size(); ++a) {
    for (std::size_t b = a + 1; b < ends.size(); ++b) {
      angles.push_back(angle_between(point(joints, ends[a]) - point(joints, joint),
                                     point(joints, ends[b]) - point(joints, joint)));
    }
  }
}

/// Joints as nanoflann reads them.
struct JointCloud {
  std::span<const float> joints;

  std::size_t kdtree_get_point_count() const { return joints.size() / 3; }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const { return joints[3 * index + axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using JointTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, JointCloud>,
                                                      JointCloud, 3, std::uint32_t>;

/// Receives joints from nanoflann, and keeps the first of equally near ones: what the tree finds first
/// depends on how it was built.
class FirstNearest {
 public:
  using DistanceType = double;

  std::uint32_t joint() const { return joint_; }

  // NOLINTBEGIN(readability-identifier-naming): nanoflann asks for these names.
  bool full() const { return true; }
  double worstDist() const { return std::nextafter(distance_, std::numeric_limits<double>::infinity()); }
  bool addPoint(double distance, std::uint32_t joint) {
    if (distance < distance_ || (distance == distance_ && joint < joint_)) {
      distance_ = distance;
      joint_ = joint;
    }
    return true;
  }
  // NOLINTEND(readability-identifier-naming)

 private:
  double distance_ = std::numeric_limits<double>::max();
  std::uint32_t joint_ = 0;
};

}  // namespace

std::vector<double> joint_angle_sums(const Skeleton& skeleton, std::span<const std::vector<float>> joints) {
  const std::vector<std::vector<std::size_t>> ends = neighbours(skeleton);
  std::vector<double> sums(ends.size(), 0.0);
  std::vector<double> last, angles;
  for (std::size_t j = 0; j < ends.size(); ++j) {
    for (std::size_t f = 0; f < joints.size(); ++f) {
      angles.clear();
      append_angles(joints[f], j, ends[j], angles);
      for (std::size_t pair = 0; f > 0 && pair < angles.size(); ++pair) {
        const double change = std::abs(angles[pair] - last[pair]);
        if (!std::isnan(change)) sums[j] += change;
      }
      std::swap(last, angles);
    }
  }
  return sums;
}

std::vector<JointMotion> judge_joints(const std::vector<double>& angle_sums, std::size_t steps,
                                      const std::optional<double>& threshold) {
  const double strongest = angle_sums.empty() ? 0 : *std::max_element(angle_sums.begin(), angle_sums.end());
  const double least =
      threshold ? *threshold * static_cast<double>(steps)
                : std::max(kShareOfStrongest * strongest, kLeastDegreesPerFrame * static_cast<double>(steps));
  std::vector<JointMotion> motions;
  motions.reserve(angle_sums.size());
  for (const double sum : angle_sums) motions.push_back({sum, sum > least});
  return motions;
}

std::vector<std::uint32_t> nearest_joints(std::span<const float> positions, std::span<const float> joints) {
  const JointCloud cloud{joints};
  const JointTree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(8));
  std::vector<std::uint32_t> nearest(positions.size() / 3);
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    FirstNearest result;
    const Vector3d at = point(positions, v);
    tree.findNeighbors(result, at.data(), {});
    nearest[v] = result.joint();
  }
  return nearest;
}

std::vector<double> skeleton_criterion(const CriterionInput& input) {
  const std::vector<std::uint32_t> joint_of = input.options.skel.region == JointRegion::kHeaviest
                                                  ? input.skeleton.heaviest_joint
                                                  : nearest_joints(input.frames[0], input.joints[0]);
  const double alpha = input.options.skel.alpha;
  std::vector<double> value(joint_of.size());
  for (std::size_t v = 0; v < value.size(); ++v)
    value[v] = input.motions[joint_of[v]].dynamic ? alpha : 1 - alpha;
  return value;
}

Status check_skeleton(const Importance& importance, const Mesh& mesh, const Skeleton& skeleton) {
  const std::size_t joint_count = skeleton.joint_names.size();
  if (!(importance.skel.alpha >= 0 && importance.skel.alpha <= 1)) {
    return invalid_argument("alpha of the skeleton criterion must lie between 0 and 1");
  }
  if (importance.skel.threshold && !(*importance.skel.threshold >= 0)) {
    return invalid_argument("the threshold of the skeleton criterion must be 0 or more degrees per frame");
  }
  if (joint_count == 0) return invalid_argument("the criterion skel needs a skeleton, and there is none");
  if (skeleton.parents.size() != joint_count) {
    return invalid_argument("the skeleton has " + std::to_string(joint_count) + " joints and parents for " +
                            std::to_string(skeleton.parents.size()));
  }
  for (std::size_t j = 0; j < joint_count; ++j) {
    if (skeleton.parents[j] < -1 || skeleton.parents[j] >= static_cast<std::int64_t>(j)) {
      return invalid_argument("joint " + std::to_string(j) + " of the skeleton comes before its parent " +
                              std::to_string(skeleton.parents[j]));
    }
  }
  if (importance.skel.region != JointRegion::kHeaviest) return {};
  if (skeleton.heaviest_joint.size() != mesh.vertex_count) {
    return invalid_argument(skeleton.heaviest_joint.empty()
                                ? "the skeleton has no skin weights to give vertices to joints"
                                : "the skeleton's skin is for another number of vertices");
  }
  const auto joint = std::max_element(skeleton.heaviest_joint.begin(), skeleton.heaviest_joint.end());
  if (joint != skeleton.heaviest_joint.end() && *joint >= joint_count) {
    return invalid_argument("the skeleton's skin names joint " + std::to_string(*joint) + " of " +
                            std::to_string(joint_count));
  }
  return {};
}

}  // namespace tvg
