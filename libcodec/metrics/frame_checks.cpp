#include "metrics/frame_checks.hpp"

#include "base/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace tvg {

bool faces_are_valid(const Mesh& mesh) {
  return std::all_of(mesh.faces.begin(), mesh.faces.end(), [&mesh](const Face& face) {
    return std::all_of(face.begin(), face.end(), [&mesh](std::uint32_t v) { return v < mesh.vertex_count; });
  });
}

Status check_positions(const Mesh& mesh, std::span<const float> positions, const char* name) {
  const std::size_t expected = std::size_t{3} * mesh.vertex_count;
  if (positions.size() != expected) {
    return invalid_argument("a frame of the " + std::string(name) + " has " + std::to_string(expected) +
                            " coordinates; got " + std::to_string(positions.size()));
  }
  const auto bad =
      std::find_if_not(positions.begin(), positions.end(), [](float value) { return std::isfinite(value); });
  if (bad == positions.end()) return {};
  const auto vertex = static_cast<std::uint64_t>(bad - positions.begin()) / 3;
  return invalid_input("vertex " + std::to_string(vertex) + " of the " + name +
                       " has a coordinate that is infinite or not a number");
}

void load_points(std::span<const float> values, Points& points) {
  points.resize(values.size() / 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v] = Eigen::Vector3d(values[3 * v], values[3 * v + 1], values[3 * v + 2]);
  }
}

double share(double value, double divisor) {
  if (value == 0) return 0;
  return divisor > 0 ? value / divisor : std::numeric_limits<double>::infinity();
}

}  // namespace tvg
