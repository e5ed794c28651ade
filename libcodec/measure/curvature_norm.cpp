#include "measure/curvature_norm.hpp"

#include "measure/frames_diagonal.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tvg {

namespace {

using Eigen::Vector3d;

/// Whether the faces around each vertex form one closed fan, [vertex]; faces that name a vertex twice are
/// left out.
std::vector<std::uint8_t> closed_fans(const Mesh& mesh, const OneRings& rings) {
  std::vector<std::uint8_t> closed(mesh.vertex_count, 0);
  std::vector<std::array<std::uint32_t, 2>> spokes;  // the other two corners of each face, in its sense
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    spokes.clear();
    for (const std::uint32_t f : rings.faces_at(v)) {
      const auto& [a, b, c] = mesh.faces[f];
      if (a == b || b == c || c == a) continue;
      spokes.push_back(a == v ? std::array{b, c} : b == v ? std::array{c, a} : std::array{a, b});
    }
    if (spokes.size() < 3) continue;
    // Walk from face to face: one fan is closed when the walk meets every face once and ends at its start.
    std::size_t met = 0;
    std::uint32_t at = spokes[0][0];
    while (met < spokes.size()) {
      const auto begins_at = [at](const auto& spoke) { return spoke[0] == at; };
      const auto next = std::find_if(spokes.begin(), spokes.end(), begins_at);
      if (next == spokes.end() || std::count_if(spokes.begin(), spokes.end(), begins_at) > 1) break;
      at = (*next)[1];
      ++met;
      if (at == spokes[0][0]) break;
    }
    closed[v] = met == spokes.size() && at == spokes[0][0] ? 1 : 0;
  }
  return closed;
}

/// What the faces add up to at a vertex.
struct Ring {
  Vector3d laplace = Vector3d::Zero();  ///< sum of (cot a + cot b) (x_i - x_j)
  Vector3d normal = Vector3d::Zero();
  double area = 0;   ///< mixed Voronoi area
  double angle = 0;  ///< sum of the angles at the vertex
};

void add_face(const Face& face, std::span<const float> positions, std::vector<Ring>& rings) {
  std::array<Vector3d, 3> at;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = Eigen::Map<const Eigen::Vector3f>(positions.data() + 3 * std::size_t{face[k]}).cast<double>();
  }
  const Vector3d normal = (at[1] - at[0]).cross(at[2] - at[0]);
  const double twice_area = normal.norm();
  if (!(twice_area > 0)) return;
  std::array<double, 3> cot{}, angle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double dot = (at[(k + 1) % 3] - at[k]).dot(at[(k + 2) % 3] - at[k]);
    cot[k] = dot / twice_area;
    angle[k] = k < 2 ? std::atan2(twice_area, dot) : std::numbers::pi - angle[0] - angle[1];
  }
  const bool obtuse = *std::min_element(cot.begin(), cot.end()) < 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    Ring& ring = rings[face[k]];
    const Vector3d to_next = at[k] - at[next], to_last = at[k] - at[last];
    ring.laplace += cot[last] * to_next + cot[next] * to_last;
    ring.normal += normal;
    ring.angle += angle[k];
    if (obtuse) {
      ring.area += twice_area / (cot[k] < 0 ? 4 : 8);
    } else {
      ring.area += (cot[last] * to_next.squaredNorm() + cot[next] * to_last.squaredNorm()) / 8;
    }
  }
}

std::vector<double> curvature_norm(const Mesh& mesh, const std::vector<std::uint8_t>& closed,
                                   std::span<const float> positions) {
  std::vector<Ring> rings(mesh.vertex_count);
  for (const Face& face : mesh.faces) {
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) add_face(face, positions, rings);
  }
  std::vector<double> norm(mesh.vertex_count, 0.0);
  for (std::size_t v = 0; v < norm.size(); ++v) {
    const Ring& ring = rings[v];
    if (!(ring.area > 0)) continue;
    if (closed[v] != 0) {
      const double mean = ring.laplace.norm() / (4 * ring.area);
      const double gauss = std::min((2 * std::numbers::pi - ring.angle) / ring.area, mean * mean);
      norm[v] = std::sqrt(4 * mean * mean - 2 * gauss);
    } else {
      const double length = ring.normal.norm();
      if (length > 0) norm[v] = std::abs(ring.laplace.dot(ring.normal)) / (2 * ring.area * length);
    }
  }
  return norm;
}

}  // namespace

std::vector<double> vertex_curvature_norm(const Mesh& mesh, const OneRings& rings,
                                          std::span<const float> positions) {
  return curvature_norm(mesh, closed_fans(mesh, rings), positions);
}

std::vector<double> curvature_norm_criterion(const CriterionInput& input) {
  const std::vector<std::uint8_t> closed = closed_fans(input.mesh, OneRings(input.mesh));
  const double diagonal = frames_diagonal(input.frames);
  return change_and_mean(input, [&](const FramePositions& frame) {
    std::vector<double> norm = curvature_norm(input.mesh, closed, frame);
    for (double& value : norm) value *= diagonal;
    return norm;
  });
}

}  // namespace tvg
