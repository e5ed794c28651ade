#pragma once
#include "measure/criterion.hpp"

#include <vector>

namespace tvg {

/// The mean over the frames of each vertex's distance from the viewpoint, as a share of the diagonal of the
/// box around the frames measured. With a negative weight near vertices matter more.
std::vector<double> viewpoint_distance_criterion(const CriterionInput& input);

Status check_viewpoint(const Importance& importance, const Mesh& mesh, const Skeleton& skeleton);

}  // namespace tvg
