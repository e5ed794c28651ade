#include "measure/curvature_norm.hpp"

#include "measure_toolbox.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace tvg {
namespace {

using std::numbers::pi;
using test::patch;

std::vector<double> norm_of(const Sequence& sequence) {
  return vertex_curvature_norm(Topology(sequence.mesh), sequence.frames[0]);
}

/// A tube of radius r along z with 24 rows of 48 vertices.
Sequence tube(double r) {
  return patch(24, 48, true, [r](double row, double column) {
    const double angle = 2 * pi * column / 48;
    return std::array{r * std::cos(angle), r * std::sin(angle), 0.13 * r * row};
  });
}

/// The definition word by word, for meshes whose vertices have closed fans but for the first and last row's.
std::vector<double> plain_norm(const Mesh& mesh, const FramePositions& positions, std::uint32_t row) {
  const auto at = [&positions](std::uint32_t v) {
    return Eigen::Map<const Eigen::Vector3f>(positions.data() + 3 * std::size_t{v}).cast<double>().eval();
  };
  std::vector<double> norm(mesh.vertex_count, 0.0);
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    Eigen::Vector3d laplace(0, 0, 0), normal(0, 0, 0);
    double area = 0, angle = 0;
    for (const Face& face : mesh.faces) {
      const auto corner = std::find(face.begin(), face.end(), v) - face.begin();
      if (corner == 3) continue;
      const Eigen::Vector3d a = at(v), b = at(face[(corner + 1) % 3]), c = at(face[(corner + 2) % 3]);
      const double twice_area = (b - a).cross(c - a).norm();
      if (twice_area == 0) continue;
      const double cot_a = (b - a).dot(c - a) / twice_area, cot_b = (a - b).dot(c - b) / twice_area,
                   cot_c = (a - c).dot(b - c) / twice_area;
      laplace += cot_c * (a - b) + cot_b * (a - c);
      normal += (b - a).cross(c - a);
      angle += std::atan2(1, cot_a);
      const bool obtuse = std::min({cot_a, cot_b, cot_c}) < 0;
      area += obtuse ? twice_area / (cot_a < 0 ? 4 : 8)
                     : (cot_c * (a - b).squaredNorm() + cot_b * (a - c).squaredNorm()) / 8;
    }
    if (area == 0) continue;
    if (v < row || v >= mesh.vertex_count - row) {
      norm[v] = std::abs(laplace.dot(normal)) / (2 * area * normal.norm());
    } else {
      const double mean = laplace.norm() / (4 * area);
      norm[v] = std::sqrt(4 * mean * mean - 2 * std::min((2 * pi - angle) / area, mean * mean));
    }
  }
  return norm;
}

/// A tube with dents, more obtuse and thinner faces than not, other in each frame.
Sequence dented_tube(std::size_t frames) {
  Sequence sequence = tube(1);
  std::uint32_t random = 1;
  const FramePositions round = sequence.frames[0];
  sequence.frames.resize(frames, round);
  for (FramePositions& frame : sequence.frames) {
    for (float& x : frame) {
      random = random * 1664525U + 1013904223U;
      x += 0.1F * static_cast<float>(random >> 8U) / 16777216.0F;
    }
  }
  return sequence;
}

TEST(CurvatureNorm, IsItsDefinition) {
  const Sequence sequence = dented_tube(1);
  const std::vector<double> norm = norm_of(sequence),
                            plain = plain_norm(sequence.mesh, sequence.frames[0], 48);
  for (std::size_t v = 0; v < norm.size(); ++v) ASSERT_NEAR(norm[v], plain[v], 1e-9 * plain[v]) << v;
}

TEST(CurvatureNorm, OfAFrameDoesNotDependOnThoseBesideIt) {
  // In the second frame one face has no area.
  Sequence sequence = dented_tube(5);
  const auto& [a, b, c] = sequence.mesh.faces[300];
  for (const std::uint32_t v : {b, c}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sequence.frames[1][3 * std::size_t{v} + axis] = sequence.frames[1][3 * std::size_t{a} + axis];
    }
  }
  std::vector<double> mean(sequence.mesh.vertex_count, 0.0);
  for (const FramePositions& frame : sequence.frames) {
    const std::vector<double> plain = plain_norm(sequence.mesh, frame, 48);
    for (std::size_t v = 0; v < mean.size(); ++v) {
      mean[v] += plain[v] * box_around(sequence.frames).diagonal() / 5;
    }
  }
  Importance options;
  options.curv.alpha = 0;
  const auto value = test::evaluate("curvature-norm", sequence.mesh, sequence.frames, options);
  for (std::size_t v = 0; v < mean.size(); ++v) ASSERT_NEAR(value[v], mean[v], 1e-9 * mean[v]) << v;
}

TEST(CurvatureNorm, OfASphereIsTheRootOfTwoOverItsRadius) {
  for (const double r : {0.5, 1.0, 40.0}) {
    // Rings between the poles, which are left open.
    const Sequence sphere = patch(31, 64, true, [r](double row, double column) {
      const double polar = 0.2 + (pi - 0.4) * row / 30, angle = 2 * pi * column / 64;
      return std::array{r * std::sin(polar) * std::cos(angle), r * std::sin(polar) * std::sin(angle),
                        r * std::cos(polar)};
    });
    const std::vector<double> norm = norm_of(sphere);
    for (std::size_t v = 64; v < norm.size() - 64; ++v) {
      ASSERT_NEAR(norm[v] * r, std::sqrt(2.0), 0.03) << "vertex " << v << ", radius " << r;
    }
  }
}

TEST(CurvatureNorm, OfACylinderIsOneOverItsRadius) {
  const std::vector<double> norm = norm_of(tube(2));
  for (std::size_t v = 48; v < norm.size() - 48; ++v) ASSERT_NEAR(norm[v], 0.5, 0.01) << v;
  // At its borders too, where only the part along the normal counts.
  for (std::size_t v = 0; v < 48; ++v) ASSERT_NEAR(norm[v], 0.5, 0.2) << v;
}

TEST(CurvatureNorm, OfAPlaneIsZeroAlsoAtItsBorder) {
  const Sequence plane = patch(6, 9, false, [](double row, double column) {
    return std::array{column + 0.3 * row, row * row * 0.2, 5.0};
  });
  for (const double norm : norm_of(plane)) EXPECT_NEAR(norm, 0, 1e-6);
}

TEST(CurvatureNorm, OfASaddleIsThatOfItsTwoCurvatures) {
  // z = a (x^2 - y^2) / 2 has k1 = a, k2 = -a at the origin.
  const double a = 0.5;
  const Sequence saddle = patch(21, 21, false, [a](double row, double column) {
    const double x = 0.05 * (column - 10), y = 0.05 * (row - 10);
    return std::array{x, y, a * (x * x - y * y) / 2};
  });
  EXPECT_NEAR(norm_of(saddle)[10 * 21 + 10], a * std::sqrt(2.0), 0.02);
}

TEST(CurvatureNorm, IsFiniteForAnyFaces) {
  Sequence tangle = tube(1);
  auto& faces = tangle.mesh.faces;
  faces.push_back(faces[100]);                       // twice
  faces.push_back({faces[7][0], faces[7][0], 3});    // a vertex twice
  faces.push_back({faces[9][0], faces[9][1], 900});  // a third face at an edge
  faces.push_back({200, 201, 202});                  // no area, see below
  for (std::size_t k = 0; k < 9; ++k) tangle.frames[0][600 + k] = 1;
  tangle.mesh.vertex_count += 1;  // no faces
  tangle.frames[0].insert(tangle.frames[0].end(), {1e18F, 0, 0});
  const std::vector<double> norm = norm_of(tangle);
  for (const double value : norm) {
    ASSERT_TRUE(std::isfinite(value));
    ASSERT_GE(value, 0);
  }
  EXPECT_EQ(norm.back(), 0);
}

TEST(CurvatureNorm, DoesNotDependOnTheUnitAsACriterion) {
  Sequence sequence = tube(2);
  const std::vector<double> value = test::evaluate("curvature-norm", sequence.mesh, sequence.frames);
  EXPECT_GT(*std::max_element(value.begin(), value.end()), 0.1);
  for (float& x : sequence.frames[0]) x *= 1024;
  const std::vector<double> scaled = test::evaluate("curvature-norm", sequence.mesh, sequence.frames);
  for (std::size_t v = 0; v < value.size(); ++v) ASSERT_NEAR(scaled[v], value[v], 1e-9 * value[v] + 1e-12);
}

TEST(CurvatureNorm, IsWeighedOverTimeAsEquation3) {
  Sequence sequence = tube(2);
  sequence.frames.push_back(tube(1).frames[0]);
  Importance options;
  options.curv.alpha = 1;
  const auto change = test::evaluate("curvature-norm", sequence.mesh, sequence.frames, options);
  options.curv.alpha = 0;
  const auto mean = test::evaluate("curvature-norm", sequence.mesh, sequence.frames, options);
  // 1/2 and 1: a mean of 3/4, off by 1/4 both times.
  for (std::size_t v = 96; v < 480; ++v) ASSERT_NEAR(change[v] / mean[v], 1.0 / 3, 1e-3);
}

}  // namespace
}  // namespace tvg
