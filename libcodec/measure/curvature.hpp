#pragma once
#include "measure/criterion.hpp"

#include <span>
#include <vector>

#include <tvg/geometry.hpp>

namespace tvg {

/// Curvature at every vertex of one frame (the paper's Eq. 1), in [0, 1]: the area-weighted mean over the
/// faces f around vertex i of (1 - n_i . n_f) / 2, with n_i the normalized area-weighted sum of their
/// normals. Faces without area add nothing; a vertex without any usable face has curvature 0.
std::vector<double> vertex_curvature(const Mesh& mesh, const OneRings& rings,
                                     std::span<const float> positions);

/// Eq. 3 of any curvature, [frame][vertex]: alpha * mean absolute deviation + (1 - alpha) * mean, over the
/// frames.
std::vector<double> change_and_mean(const CriterionInput& input,
                                    std::span<const std::vector<double>> curvature);

/// CURV: Eq. 3 of Eq. 1.
std::vector<double> curvature_criterion(const CriterionInput& input);

/// kInvalidArgument unless alpha is in range; of every criterion that goes by Eq. 3.
Status check_curvature(const Importance& importance, const Mesh& mesh, const Skeleton& skeleton);

}  // namespace tvg
