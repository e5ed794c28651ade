#include "measure/user_weights.hpp"

#include "base/errors.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace tvg {

std::vector<double> user_weights_criterion(const CriterionInput& input) {
  return input.options.weights;
}

Status check_user_weights(const Importance& importance, const Mesh& mesh, const Skeleton&) {
  if (importance.weights.size() != mesh.vertex_count) {
    return invalid_argument("there are " + std::to_string(importance.weights.size()) +
                            " weights for the mesh's " + std::to_string(mesh.vertex_count) + " vertices");
  }
  const auto bad = std::find_if_not(importance.weights.begin(), importance.weights.end(),
                                    [](double weight) { return std::isfinite(weight); });
  if (bad == importance.weights.end()) return {};
  return invalid_argument("the weight of vertex " + std::to_string(bad - importance.weights.begin()) +
                          " is infinite or not a number");
}

}  // namespace tvg
