#include "base/errors.hpp"
#include "geometry/topology.hpp"
#include "measure/criterion.hpp"
#include "measure/importance.hpp"
#include "measure/joint_motion.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <tvg/measure.hpp>

namespace tvg {

namespace {

std::string known_names() {
  std::string names;
  for (const Criterion& criterion : criteria()) {
    names += (names.empty() ? "" : ", ") + std::string(criterion.name);
  }
  return names;
}

Status check_sizes(const Mesh& mesh, std::span<const FramePositions> frames, const Skeleton& skeleton,
                   std::span<const std::vector<float>> joints, bool with_joints) {
  if (frames.empty()) return invalid_argument("there is no frame to measure");
  const std::size_t vertex_values = 3 * std::size_t{mesh.vertex_count};
  for (const FramePositions& frame : frames) {
    if (frame.size() != vertex_values) return invalid_argument("a frame has not the mesh's vertices");
  }
  if (!with_joints) return {};
  if (joints.size() != frames.size()) {
    return invalid_argument("there are " + std::to_string(joints.size()) + " frames of joints for " +
                            std::to_string(frames.size()) + " of vertices");
  }
  for (const std::vector<float>& frame : joints) {
    if (frame.size() != 3 * skeleton.joint_names.size()) {
      return invalid_argument("a frame has not the skeleton's joints");
    }
  }
  return {};
}

}  // namespace

std::vector<CriterionDescription> criterion_descriptions() {
  std::vector<CriterionDescription> descriptions;
  for (const Criterion& criterion : criteria()) {
    descriptions.push_back({criterion.name, criterion.description});
  }
  return descriptions;
}

bool uses_skeleton(const Importance& importance) {
  return std::any_of(importance.criteria.begin(), importance.criteria.end(), [](const CriterionWeight& term) {
    const Criterion* criterion = find_criterion(term.name);
    return criterion != nullptr && criterion->uses_skeleton;
  });
}

Status check_importance(const Importance& importance, const Mesh& mesh, const Skeleton& skeleton) {
  if (!(importance.share >= 0 && importance.share <= 1)) {
    return invalid_argument("the share of important vertices must lie between 0 and 1");
  }
  if (importance.smoothing > kMaxSmoothing) {
    return invalid_argument("the cost can be averaged " + std::to_string(kMaxSmoothing) + " times at most");
  }
  if (importance.criteria.empty()) return invalid_argument("the measure needs at least one criterion");
  for (const CriterionWeight& term : importance.criteria) {
    const Criterion* criterion = find_criterion(term.name);
    if (criterion == nullptr) {
      return invalid_argument("there is no criterion '" + term.name + "', but " + known_names());
    }
    if (!std::isfinite(term.weight)) {
      return invalid_argument("the weight of '" + term.name + "' must be a finite number");
    }
    if (criterion->check == nullptr) continue;
    if (Status status = criterion->check(importance, mesh, skeleton); !status.ok()) return status;
  }
  return {};
}

Measurer::Measurer(const Mesh& mesh, const Skeleton& skeleton, const Importance& importance)
    : topology_(std::make_unique<Topology>(mesh)), skeleton_(skeleton), importance_(importance) {}
Measurer::~Measurer() = default;

Result<Measure> Measurer::measure(std::span<const FramePositions> frames,
                                  std::span<const std::vector<float>> joints) const {
  const Mesh& mesh = topology_->mesh();
  const bool with_joints = uses_skeleton(importance_);
  if (Status status = check_importance(importance_, mesh, skeleton_); !status.ok()) return status.error();
  if (Status status = check_sizes(mesh, frames, skeleton_, joints, with_joints); !status.ok())
    return status.error();
  Measure result;
  if (with_joints) {
    result.joints =
        judge_joints(joint_angle_sums(skeleton_, joints), joints.size() - 1, importance_.skel.threshold);
  }
  result.cost =
      cost(terms_of(importance_), {*topology_, frames, importance_, skeleton_, joints, result.joints});
  smooth_cost(mesh, importance_.smoothing, result.cost);
  result.flags = importance_.threshold ? flag_above(result.cost, *importance_.threshold)
                                       : flag_highest_share(result.cost, importance_.share);
  return result;
}

Result<Measure> measure(const Mesh& mesh, std::span<const FramePositions> frames, const Skeleton& skeleton,
                        std::span<const std::vector<float>> joints, const Importance& importance) {
  return Measurer(mesh, skeleton, importance).measure(frames, joints);
}

}  // namespace tvg
