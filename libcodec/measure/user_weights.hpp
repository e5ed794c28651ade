#pragma once
#include "measure/criterion.hpp"

#include <vector>

namespace tvg {

/// What the user says each vertex is worth, as it is.
std::vector<double> user_weights_criterion(const CriterionInput& input);

Status check_user_weights(const Importance& importance, const Mesh& mesh, const Skeleton& skeleton);

}  // namespace tvg
