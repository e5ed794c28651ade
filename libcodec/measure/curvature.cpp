#include "measure/curvature.hpp"

#include "base/errors.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace tvg {

std::vector<double> vertex_curvature(const Mesh& mesh, const OneRings& rings,
                                     std::span<const float> positions) {
  const auto position = [&positions](std::uint32_t v) {
    return Eigen::Map<const Eigen::Vector3f>(positions.data() + 3 * std::size_t{v}).cast<double>();
  };
  std::vector<Eigen::Vector3d> area_normals(mesh.faces.size());  // length: twice the area
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = mesh.faces[f];
    const Eigen::Vector3d origin = position(a);
    area_normals[f] = (position(b) - origin).cross(position(c) - origin);
  }
  std::vector<double> areas(mesh.faces.size());
  for (std::size_t f = 0; f < areas.size(); ++f) areas[f] = area_normals[f].norm();

  std::vector<double> curvature(mesh.vertex_count, 0.0);
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double total_area = 0;
    for (const std::uint32_t f : rings.faces_at(v)) {
      normal += area_normals[f];
      total_area += areas[f];
    }
    const double length = normal.norm();
    if (!(total_area > 0)) continue;
    // a_f (1 - n_i . n_f) / 2 summed over f: the face normals' lengths are their areas. Opposite faces can
    // cancel to no normal at all; every face then counts as perpendicular to it.
    double sum = 0;
    for (const std::uint32_t f : rings.faces_at(v)) {
      const double along = length > 0 ? normal.dot(area_normals[f]) / length : 0.0;
      sum += (areas[f] - along) / 2;
    }
    curvature[v] = std::max(0.0, sum / total_area);
  }
  return curvature;
}

std::vector<double> change_and_mean(const CriterionInput& input,
                                    std::span<const std::vector<double>> curvature) {
  const std::size_t vertex_count = input.mesh().vertex_count;
  const auto frame_count = static_cast<double>(curvature.size());
  std::vector<double> mean(vertex_count, 0.0);
  for (const std::vector<double>& frame : curvature) {
    for (std::size_t v = 0; v < vertex_count; ++v) mean[v] += frame[v] / frame_count;
  }
  std::vector<double> deviation(vertex_count, 0.0);
  for (const std::vector<double>& frame : curvature) {
    for (std::size_t v = 0; v < vertex_count; ++v) {
      deviation[v] += std::abs(frame[v] - mean[v]) / frame_count;
    }
  }
  const double alpha = input.options.curv.alpha;
  std::vector<double> value(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) value[v] = alpha * deviation[v] + (1 - alpha) * mean[v];
  return value;
}

std::vector<double> curvature_criterion(const CriterionInput& input) {
  std::vector<std::vector<double>> curvature;
  for (const FramePositions& frame : input.frames) {
    curvature.push_back(vertex_curvature(input.mesh(), input.topology.rings(), frame));
  }
  return change_and_mean(input, curvature);
}

Status check_curvature(const Importance& importance, const Mesh&, const Skeleton&) {
  if (importance.curv.alpha >= 0 && importance.curv.alpha <= 1) return {};
  return invalid_argument("alpha must lie between 0 and 1");
}

}  // namespace tvg
