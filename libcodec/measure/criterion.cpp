#include "measure/criterion.hpp"

#include "measure/curvature.hpp"

#include <array>

namespace tvg {

namespace {

constexpr std::array<Criterion, 1> kCriteria = {{
    {"curv", curvature_criterion},
}};

}  // namespace

std::span<const Criterion> criteria() {
  return kCriteria;
}

std::vector<double> cost(std::span<const WeightedCriterion> terms, const CriterionInput& input) {
  std::vector<double> total(input.mesh.vertex_count, 0.0);
  for (const WeightedCriterion& term : terms) {
    const std::vector<double> values = term.criterion->evaluate(input);
    for (std::size_t v = 0; v < total.size(); ++v) total[v] += term.weight * values[v];
  }
  return total;
}

}  // namespace tvg
