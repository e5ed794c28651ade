#include "simplify/quadric_error.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include <tvg/geometry.hpp>

namespace tvg {
namespace {

using Eigen::Vector3d;

Vector3d position(std::span<const float> positions, std::uint32_t vertex) {
  return Eigen::Map<const Eigen::Vector3f>(positions.data() + 3 * std::size_t{vertex}).cast<double>();
}

/// The upper half of a symmetric matrix: xx, xy, xz, yy, yz, zz.
using Quadric = std::array<double, 6>;

/// [vertex] The sum over the planes around it of n n^T: all of them run through the vertex, so that the
/// squared distances of a point d away from it add up to d^T Q d.
void plane_quadrics(const Mesh& mesh, std::span<const float> positions, std::span<Quadric> quadrics) {
  std::fill(quadrics.begin(), quadrics.end(), Quadric{});
  for (const auto& [a, b, c] : mesh.faces) {
    const Vector3d origin = position(positions, a);
    const Vector3d area = (position(positions, b) - origin).cross(position(positions, c) - origin);
    const double length = area.norm();
    if (!(length > 0)) continue;
    const Vector3d n = area / length;
    const Quadric of_face = {n.x() * n.x(), n.x() * n.y(), n.x() * n.z(),
                             n.y() * n.y(), n.y() * n.z(), n.z() * n.z()};
    for (const std::uint32_t v : {a, b, c}) {
      for (std::size_t k = 0; k < of_face.size(); ++k) quadrics[v][k] += of_face[k];
    }
  }
}

double distance_from_planes(const Quadric& q, const Vector3d& d) {
  const double x = d.x(), y = d.y(), z = d.z();
  return q[0] * x * x + q[3] * y * y + q[5] * z * z + 2 * (q[1] * x * y + q[2] * x * z + q[4] * y * z);
}

}  // namespace

std::vector<std::vector<double>> quadric_errors(const Mesh& mesh, std::span<const FramePositions> frames,
                                                std::span<const std::vector<PlacedVertex>> levels) {
  const double extent = box_around(frames).largest_extent();
  const double scale = extent > 0 ? 1 / (extent * extent) : 0;
  std::vector<std::vector<double>> errors(levels.size());
  std::vector<Quadric> quadrics(mesh.vertex_count);
  for (const FramePositions& frame : frames) {
    plane_quadrics(mesh, frame, quadrics);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      double sum = 0;
      for (const PlacedVertex& placed : levels[level]) {
        const Vector3d from = position(frame, placed.vertex);
        Vector3d moved = Vector3d::Zero();
        for (std::size_t c = 0; c < 3; ++c) {
          moved += placed.weights[c] * (position(frame, placed.corners[c]) - from);
        }
        sum += distance_from_planes(quadrics[placed.vertex], moved);
      }
      errors[level].push_back(scale * sum);
    }
  }
  return errors;
}

}  // namespace tvg
