#pragma once
#include "measure/criterion.hpp"

#include <cstdint>
#include <span>
#include <vector>

// SKEL: joints at which the skeleton bends, and the vertices around them.
namespace tvg {

/// Per joint, and per pair of the segments that meet at it (those to its parent and to each child), the sum
/// over the frames of the absolute change of the angle between them (Eq. 4 and 5), in degrees. A pair one of
/// whose segments has no length in one of two frames adds nothing between these. `joints` is
/// [frame][joint][xyz].
std::vector<double> joint_angle_sums(const Skeleton& skeleton, std::span<const std::vector<float>> joints);

/// The sums, and which joints are dynamic: those whose sum is above `threshold` degrees for each of the
/// `steps` from frame to frame.
/// Without a threshold, a quarter of the strongest joint's sum and at least 0.1 degrees per step have to be
/// passed. Which joints matter depends on how strongly the others move: a fixed angle would find everything
/// dynamic in a dance and nothing in a breath. But relative to the strongest alone, a pose that is held would
/// have dynamic joints by the noise of a capture or of float32 positions; the fixed part keeps these out.
std::vector<JointMotion> judge_joints(const std::vector<double>& angle_sums, std::size_t steps,
                                      const std::optional<double>& threshold);

/// The joint nearest to each vertex, [vertex]; of equally near ones the first. `positions` is [vertex][xyz],
/// `joints` [joint][xyz], at least one.
std::vector<std::uint32_t> nearest_joints(std::span<const float> positions, std::span<const float> joints);

/// SKEL (Eq. 6): its alpha at vertices that belong to a dynamic joint, 1 - alpha at others.
std::vector<double> skeleton_criterion(const CriterionInput& input);

Status check_skeleton(const Importance& importance, const Mesh& mesh, const Skeleton& skeleton);

}  // namespace tvg
