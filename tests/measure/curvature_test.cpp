#include "measure/curvature.hpp"

#include "measure_toolbox.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace tvg {
namespace {

constexpr double kTolerance = 1e-12;

double curvature_at(std::uint32_t vertex, const Mesh& mesh, const FramePositions& positions) {
  return vertex_curvature(mesh, OneRings(mesh), positions)[vertex];
}

/// Two triangles on the edge 0-1 (the x axis, length 1), of these areas, folded by this angle.
FramePositions fold(double area_a, double area_b, double angle) {
  const auto y = static_cast<float>(-2 * area_b * std::cos(angle)),
             z = static_cast<float>(-2 * area_b * std::sin(angle));
  return {0, 0, 0, 1, 0, 0, 0, static_cast<float>(2 * area_a), 0, 0, y, z};
}
const Mesh kFold{4, {{0, 1, 2}, {1, 0, 3}}};

TEST(Curvature, FlatFanHasNone) {
  const Mesh fan{5, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  const FramePositions flat = {0, 0, 1, 1, 0, 1, 0, 2, 1, -1, 0, 1, 0, -1, 1};
  for (const double value : vertex_curvature(fan, OneRings(fan), flat)) EXPECT_NEAR(value, 0, kTolerance);
}

TEST(Curvature, CornerOfACubeIsEquation1WorkedByHand) {
  // Three perpendicular faces of one area: n_i = (1, 1, 1) / sqrt(3), so n_i . n_f = 1 / sqrt(3).
  const Mesh corner{4, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}};
  const FramePositions at = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_NEAR(curvature_at(0, corner, at), (1 - 1 / std::sqrt(3.0)) / 2, kTolerance);
  // Vertex 1 has two perpendicular faces: n_i . n_f = 1 / sqrt(2).
  EXPECT_NEAR(curvature_at(1, corner, at), (1 - 1 / std::sqrt(2.0)) / 2, kTolerance);
}

TEST(Curvature, FoldIsWeightedByArea) {
  // Normals at right angles with areas 1 and 3: |n| = sqrt(10), sum a_f n_i . n_f = sqrt(10).
  EXPECT_NEAR(curvature_at(0, kFold, fold(1, 3, std::acos(0.0))), (4 - std::sqrt(10.0)) / 2 / 4, 1e-7);
  EXPECT_NEAR(curvature_at(1, kFold, fold(1, 1, std::acos(0.0))), (1 - std::sqrt(0.5)) / 2, 1e-7);
  EXPECT_NEAR(curvature_at(2, kFold, fold(1, 3, std::acos(0.0))), 0, 1e-7) << "one face only";
}

TEST(Curvature, DoesNotDependOnSizeOrOrientation) {
  FramePositions positions = fold(1, 2, 1.0);
  const double value = curvature_at(0, kFold, positions);
  EXPECT_GT(value, 0.01);
  for (float& x : positions) x *= 1024;
  EXPECT_NEAR(curvature_at(0, kFold, positions), value, kTolerance);
  const Mesh turned{4, {{1, 0, 2}, {0, 1, 3}}};
  EXPECT_NEAR(curvature_at(0, turned, positions), value, kTolerance);
}

TEST(Curvature, FacesWithoutAreaAddNothing) {
  Mesh mesh = kFold;
  mesh.vertex_count = 5;
  mesh.faces.push_back({0, 1, 4});  // on a line
  mesh.faces.push_back({0, 0, 1});  // a vertex twice
  FramePositions positions = fold(1, 2, 1.0);
  const double value = curvature_at(0, kFold, positions);
  positions.insert(positions.end(), {0.5f, 0, 0});
  EXPECT_NEAR(curvature_at(0, mesh, positions), value, kTolerance);
  EXPECT_EQ(curvature_at(4, mesh, positions), 0) << "no usable face";
}

TEST(Curvature, IsolatedVertexHasNone) {
  const Mesh mesh{4, {{0, 1, 2}}};
  EXPECT_EQ(curvature_at(3, mesh, {0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9}), 0);
}

TEST(Curvature, AFaceAndItsBackAreAsFarApartAsAHalf) {
  const Mesh mesh{3, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_NEAR(curvature_at(0, mesh, {0, 0, 0, 1, 0, 0, 0, 1, 0}), 0.5, kTolerance);
}

TEST(Curvature, StaysBetweenZeroAndOneForLargeAndSmallMeshes) {
  for (const float scale : {1e-30f, 1e-12f, 1.0f, 1e12f, 1e18f}) {
    FramePositions positions = fold(1, 2, 2.5);
    for (float& x : positions) x *= scale;
    for (const double value : vertex_curvature(kFold, OneRings(kFold), positions)) {
      EXPECT_GE(value, 0) << scale;
      EXPECT_LE(value, 1) << scale;
    }
  }
}

TEST(CurvatureOverTime, IsEquation3WorkedByHandOverThreeFrames) {
  const double right = std::acos(0.0);
  // Flat, a right angle, flat: k, 0, k with k = (1 - sqrt(1/2)) / 2.
  const std::vector<FramePositions> frames = {fold(1, 1, 0), fold(1, 1, right), fold(1, 1, 0)};
  const double k = (1 - std::sqrt(0.5)) / 2;
  const double mean = k / 3;
  const double deviation = (mean + (k - mean) + mean) / 3;  // 4 k / 9
  for (const double alpha : {0.0, 0.25, 0.5, 1.0}) {
    Importance options;
    options.curv.alpha = alpha;
    const std::vector<double> value = test::evaluate("curv", kFold, frames, options);
    EXPECT_NEAR(value[0], alpha * deviation + (1 - alpha) * mean, 1e-7) << alpha;
    EXPECT_NEAR(value[1], value[0], 1e-12);
    EXPECT_NEAR(value[2], 0, 1e-7);
  }
  EXPECT_NEAR(deviation, 4 * k / 9, 1e-15);
}

TEST(CurvatureOverTime, StillFramesHaveNoDeviation) {
  const std::vector<FramePositions> frames(3, fold(1, 1, 1.0));
  Importance options;
  options.curv.alpha = 1;
  EXPECT_NEAR(test::evaluate("curv", kFold, frames, options)[0], 0, 1e-12);
  options.curv.alpha = 0;
  EXPECT_NEAR(test::evaluate("curv", kFold, frames, options)[0], curvature_at(0, kFold, frames[0]), 1e-12);
}

}  // namespace
}  // namespace tvg
