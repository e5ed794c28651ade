#include "measure/criterion.hpp"

#include "measure/curvature.hpp"

#include <array>

namespace tvg {

namespace {

constexpr std::array<Criterion, 1> kCriteria = {{
    {"curv", curvature_criterion},
}};

constexpr std::array<WeightedCriterion, 1> kDefaultTerms = {{{&kCriteria[0], 1.0}}};

}  // namespace

std::span<const Criterion> criteria() {
  return kCriteria;
}

std::span<const WeightedCriterion> default_terms() {
  return kDefaultTerms;
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
