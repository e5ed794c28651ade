#include "measure/viewpoint_distance.hpp"

#include "base/errors.hpp"

#include <algorithm>
#include <cmath>

namespace tvg {

std::vector<double> viewpoint_distance_criterion(const CriterionInput& input) {
  std::vector<double> distance(input.mesh().vertex_count, 0.0);
  const double diagonal = box_around(input.frames).diagonal();
  if (!(diagonal > 0)) return distance;
  const double scale = 1 / (diagonal * static_cast<double>(input.frames.size()));
  const auto& [x, y, z] = input.options.distance.viewpoint;
  for (const FramePositions& frame : input.frames) {
    for (std::size_t v = 0; v < distance.size(); ++v) {
      distance[v] += scale * std::hypot(frame[3 * v] - x, frame[3 * v + 1] - y, frame[3 * v + 2] - z);
    }
  }
  return distance;
}

Status check_viewpoint(const Importance& importance, const Mesh&, const Skeleton&) {
  const bool finite = std::all_of(importance.distance.viewpoint.begin(), importance.distance.viewpoint.end(),
                                  [](double x) { return std::isfinite(x); });
  if (finite) return {};
  return invalid_argument("the viewpoint must be a place in the mesh's units");
}

}  // namespace tvg
