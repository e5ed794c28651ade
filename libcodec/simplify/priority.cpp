#include "simplify/priority.hpp"

#include "measure/curvature.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include <tvg/geometry.hpp>

namespace tvg {
namespace {

void add_areas(const Mesh& mesh, std::span<const float> positions, std::span<double> areas) {
  const auto position = [&positions](std::uint32_t v) {
    return Eigen::Map<const Eigen::Vector3f>(positions.data() + 3 * std::size_t{v}).cast<double>();
  };
  for (const auto& [a, b, c] : mesh.faces) {
    const Eigen::Vector3d origin = position(a);
    const double area = (position(b) - origin).cross(position(c) - origin).norm() / 2;
    for (const std::uint32_t v : {a, b, c}) areas[v] += area;
  }
}

}  // namespace

std::vector<double> maps_priorities(const Mesh& mesh, std::span<const FramePositions> frames, double lambda) {
  const OneRings rings(mesh);
  std::vector<double> areas(mesh.vertex_count, 0.0), curvatures(mesh.vertex_count, 0.0);
  for (const FramePositions& frame : frames) {
    add_areas(mesh, frame, areas);
    const std::vector<double> of_frame = vertex_curvature(mesh, rings, frame);
    for (std::size_t v = 0; v < of_frame.size(); ++v) curvatures[v] += of_frame[v];
  }
  const double largest_area = *std::max_element(areas.begin(), areas.end());
  const double largest_curvature = *std::max_element(curvatures.begin(), curvatures.end());
  std::vector<double> priorities(mesh.vertex_count, 0.0);
  for (std::size_t v = 0; v < priorities.size(); ++v) {
    if (largest_area > 0) priorities[v] += lambda * areas[v] / largest_area;
    if (largest_curvature > 0) priorities[v] += (1 - lambda) * curvatures[v] / largest_curvature;
  }
  return priorities;
}

}  // namespace tvg
