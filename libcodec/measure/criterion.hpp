#pragma once
#include "geometry/topology.hpp"

#include <span>
#include <string_view>
#include <vector>

#include <tvg/measure.hpp>

// Criteria by name, each of which says how much every vertex matters to the animation (Eq. 2).
namespace tvg {

struct CriterionInput {
  const Topology& topology;                ///< of the mesh, shared by all criteria and GOPs
  std::span<const FramePositions> frames;  ///< those measured, [frame][vertex][xyz]; at least one
  const Importance& options;
  const Skeleton& skeleton;
  std::span<const std::vector<float>> joints;  ///< [frame][joint][xyz]; empty without `uses_skeleton`
  std::span<const JointMotion> motions;        ///< [joint]; empty without `uses_skeleton`

  const Mesh& mesh() const { return topology.mesh(); }
};

struct Criterion {
  std::string_view name;
  std::string_view description;                            ///< one line
  std::vector<double> (*evaluate)(const CriterionInput&);  ///< [vertex], finite
  /// Whether the criterion finds what it needs; null where it needs nothing but frames.
  Status (*check)(const Importance&, const Mesh&, const Skeleton&) = nullptr;
  bool uses_skeleton = false;
};

/// Every criterion there is. To add one, write its file and add its line to the table in criterion.cpp.
std::span<const Criterion> criteria();

/// The criterion of that name, or null.
const Criterion* find_criterion(std::string_view name);

struct WeightedCriterion {
  const Criterion* criterion;
  double weight;  ///< may be negative
};

/// Eq. 2: c_i = sum of w_k f_k(i), [vertex].
std::vector<double> cost(std::span<const WeightedCriterion> terms, const CriterionInput& input);

/// The criteria that `importance` names; all names are known.
std::vector<WeightedCriterion> terms_of(const Importance& importance);

}  // namespace tvg
