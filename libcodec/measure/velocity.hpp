#pragma once
#include "measure/criterion.hpp"

#include <vector>

namespace tvg {

/// The mean distance that each vertex moves from one frame to the next, as a share of the diagonal of the
/// box around the frames measured: 0 for a vertex at rest and where there is one frame only, 1 for one that
/// goes from corner to corner every time.
std::vector<double> velocity_criterion(const CriterionInput& input);

}  // namespace tvg
