#pragma once
#include <span>
#include <string_view>
#include <vector>

#include <tvg/mesh.hpp>
#include <tvg/sequence.hpp>

// The measure (the paper's Eq. 2): criteria by name, each of which says how much every vertex matters to the
// animation.
namespace tvg {

struct CriterionInput {
  const Mesh& mesh;
  std::span<const FramePositions> frames;  ///< of one GOP, [frame][vertex][xyz]
  double alpha;                            ///< 0 to 1: weight of change against state
};

struct Criterion {
  std::string_view name;
  std::vector<double> (*evaluate)(const CriterionInput&);  ///< [vertex]
};

/// Every criterion there is. To add one, write its file and add its line to the table in criterion.cpp.
std::span<const Criterion> criteria();

struct WeightedCriterion {
  const Criterion* criterion;
  double weight;  ///< may be negative
};

/// The terms that choose important vertices unless the caller says otherwise.
std::span<const WeightedCriterion> default_terms();

/// Eq. 2: c_i = sum of w_k f_k(i), [vertex].
std::vector<double> cost(std::span<const WeightedCriterion> terms, const CriterionInput& input);

}  // namespace tvg
