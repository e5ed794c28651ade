#include "measure/criterion.hpp"

#include "measure/curvature.hpp"
#include "measure/curvature_norm.hpp"
#include "measure/joint_motion.hpp"
#include "measure/user_weights.hpp"
#include "measure/velocity.hpp"
#include "measure/viewpoint_distance.hpp"

#include <algorithm>
#include <array>

namespace tvg {

namespace {

constexpr std::array<Criterion, 6> kCriteria = {{
    {"curv", "curvature and its change (Eq. 3)", curvature_criterion, check_curvature},
    {"skel", "whether the nearest joint bends (Eq. 6)", skeleton_criterion, check_skeleton, true},
    {"curvature-norm", "curvature as sqrt(k1^2 + k2^2), and its change", curvature_norm_criterion,
     check_curvature},
    {"velocity", "mean way from frame to frame", velocity_criterion},
    {"distance", "distance from a viewpoint", viewpoint_distance_criterion, check_viewpoint},
    {"weights", "values of your own", user_weights_criterion, check_user_weights},
}};

}  // namespace

std::span<const Criterion> criteria() {
  return kCriteria;
}

const Criterion* find_criterion(std::string_view name) {
  const auto found = std::find_if(kCriteria.begin(), kCriteria.end(),
                                  [name](const Criterion& criterion) { return criterion.name == name; });
  return found == kCriteria.end() ? nullptr : &*found;
}

std::vector<double> cost(std::span<const WeightedCriterion> terms, const CriterionInput& input) {
  std::vector<double> total(input.mesh().vertex_count, 0.0);
  for (const WeightedCriterion& term : terms) {
    const std::vector<double> values = term.criterion->evaluate(input);
    for (std::size_t v = 0; v < total.size(); ++v) total[v] += term.weight * values[v];
  }
  return total;
}

std::vector<WeightedCriterion> terms_of(const Importance& importance) {
  std::vector<WeightedCriterion> terms;
  for (const CriterionWeight& term : importance.criteria) {
    terms.push_back({find_criterion(term.name), term.weight});
  }
  return terms;
}

}  // namespace tvg
