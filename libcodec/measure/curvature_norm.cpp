#include "measure/curvature_norm.hpp"

#include "measure/curvature.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tvg {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// What the faces add up to at a vertex.
struct Ring {
  Vector3d laplace = Vector3d::Zero();  ///< sum of (cot a + cot b) (x_i - x_j)
  Vector3d normal = Vector3d::Zero();   ///< sum of area normals
  double area = 0;                      ///< mixed Voronoi area
  double angle = 0;                     ///< sum of the angles at the vertex
};

void add_face(const Face& face, std::span<const float> positions, std::span<Ring> rings) {
  const auto position = [positions](std::uint32_t v) {
    return Eigen::Map<const Eigen::Vector3f>(positions.data() + 3 * std::size_t{v}).cast<double>().eval();
  };
  const Vector3d a = position(face[0]), b = position(face[1]), c = position(face[2]);
  const std::array<Vector3d, 3> edge = {c - b, a - c, b - a};  // across from each corner
  const Vector3d normal = edge[1].cross(edge[2]);
  const double twice_area = normal.norm();
  if (!(twice_area > 0)) return;
  // Around the face one edge comes to a corner and one leaves it: hence the sign.
  const std::array<double, 3> cot = {-edge[1].dot(edge[2]) / twice_area, -edge[2].dot(edge[0]) / twice_area,
                                     -edge[0].dot(edge[1]) / twice_area};
  const double angle_a = std::atan2(1, cot[0]), angle_b = std::atan2(1, cot[1]);
  const std::array<double, 3> angle = {angle_a, angle_b, pi - angle_a - angle_b};
  const bool obtuse = std::min({cot[0], cot[1], cot[2]}) < 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    Ring& ring = rings[face[k]];
    ring.laplace += cot[next] * edge[next] - cot[last] * edge[last];
    ring.normal += normal;
    ring.angle += angle[k];
    // The Voronoi area (cot b |edge b|^2 + cot c |edge c|^2) / 8 at corner a is (1 + cot b cot c) A / 4, for
    // |edge b|^2 = 2A (cot a + cot c) and cot a cot b + cot b cot c + cot c cot a = 1. In an obtuse triangle
    // A / 2 at the obtuse corner and A / 4 at the others take its place.
    const double share = obtuse ? (cot[k] < 0 ? 2 : 1) : 1 + cot[next] * cot[last];
    ring.area += share * twice_area / 8;
  }
}

double norm_of(const Ring& ring, bool closed) {
  if (!(ring.area > 0)) return 0;
  if (closed) {
    const double squared_mean = ring.laplace.squaredNorm() / (16 * ring.area * ring.area);
    const double gauss = std::min((2 * pi - ring.angle) / ring.area, squared_mean);
    return std::sqrt(4 * squared_mean - 2 * gauss);
  }
  const double length = ring.normal.norm();
  return length > 0 ? std::abs(ring.laplace.dot(ring.normal)) / (2 * ring.area * length) : 0;
}

}  // namespace

std::vector<double> vertex_curvature_norm(const Topology& topology, std::span<const float> positions) {
  const Mesh& mesh = topology.mesh();
  std::vector<Ring> rings(mesh.vertex_count);
  for (const Face& face : mesh.faces) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    add_face(face, positions, rings);
  }
  const std::vector<std::uint8_t>& closed = topology.closed_fans();
  std::vector<double> norm(mesh.vertex_count);
  for (std::size_t v = 0; v < norm.size(); ++v) norm[v] = norm_of(rings[v], closed[v] != 0);
  return norm;
}

std::vector<double> curvature_norm_criterion(const CriterionInput& input) {
  const double diagonal = box_around(input.frames).diagonal();
  std::vector<std::vector<double>> norms;
  for (const FramePositions& frame : input.frames) {
    norms.push_back(vertex_curvature_norm(input.topology, frame));
    for (double& norm : norms.back()) norm *= diagonal;
  }
  return change_and_mean(input, norms);
}

}  // namespace tvg
