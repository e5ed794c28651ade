#pragma once
#include "measure/criterion.hpp"

#include <span>
#include <vector>

namespace tvg {

/// The discrete curvature norm sqrt(k1^2 + k2^2) = sqrt(4 H^2 - 2 K) at every vertex of one frame, [vertex],
/// in 1 / unit of the mesh: sqrt(2) / r on a sphere, 1 / r on a cylinder, 0 on a plane.
/// H = |sum over the ring's edges of (cot a + cot b) (x_i - x_j)| / (4 A), a and b the angles across the
/// edge; K = (2 pi - sum of the angles at i) / A; A is the mixed Voronoi area of the ring. K is taken as at
/// most H^2, as it is for real k1 and k2.
/// Where the faces around a vertex are not one closed fan (boundaries, non-manifold vertices), K has no
/// meaning and the sum over edges points along the surface too: there K = 0 and only the part of the sum
/// along the ring's normal counts. Faces without area add nothing; a vertex without any other has 0.
std::vector<double> vertex_curvature_norm(const Topology& topology, std::span<const float> positions);

/// As CURV (Eq. 3) does with its curvature: alpha * mean absolute deviation + (1 - alpha) * mean over the
/// frames. The norm is multiplied by the diagonal of the box around the frames, so that the unit of length
/// does not matter.
std::vector<double> curvature_norm_criterion(const CriterionInput& input);

}  // namespace tvg
