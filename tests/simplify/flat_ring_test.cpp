#include "simplify/flat_ring.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <vector>

namespace tvg {
namespace {

constexpr double kPi = std::numbers::pi;

void expect_point(const PlanePoint& point, double x, double y) {
  EXPECT_NEAR(point[0], x, 1e-12);
  EXPECT_NEAR(point[1], y, 1e-12);
}

TEST(FlatRing, AConeOfThreeRightAnglesOpensToAFullTurn) {
  // The corner of a cube: 3 pi / 2 becomes 2 pi, a = 4/3. Radii of mean 1 are raised to the same power.
  const std::vector<double> angles(3, kPi / 2), radii = {0.5, 1.0, 1.5};
  const std::vector<PlanePoint> plane = flatten_ring(angles, radii, true);
  ASSERT_EQ(plane.size(), 3u);
  const double near = std::pow(0.5, 4.0 / 3), far = std::pow(1.5, 4.0 / 3);
  expect_point(plane[0], near, 0);
  expect_point(plane[1], -0.5, std::sqrt(3) / 2);
  expect_point(plane[2], -far / 2, -far * std::sqrt(3) / 2);
}

TEST(FlatRing, TheChainOfABoundaryVertexBecomesAHalfTurn) {
  const std::vector<double> angles = {kPi / 4, kPi / 4}, radii = {2, 2, 2};
  const std::vector<PlanePoint> plane = flatten_ring(angles, radii, false);
  expect_point(plane[0], 1, 0);
  expect_point(plane[1], 0, 1);
  expect_point(plane[2], -1, 0);
}

TEST(FlatRing, SpikesAndVerticesInOnePlaceStayFinite) {
  const std::vector<double> angles = {1e-9, 0, 1e-9, 0}, radii = {1, 0, 1e9, 0};
  for (const PlanePoint& point : flatten_ring(angles, radii, true)) {
    EXPECT_TRUE(std::isfinite(point[0]) && std::isfinite(point[1]));
    EXPECT_GT(std::hypot(point[0], point[1]), 0);
  }
  const std::vector<double> nothing(4, 0.0);
  for (const PlanePoint& point : flatten_ring(nothing, nothing, true)) {
    EXPECT_NEAR(std::hypot(point[0], point[1]), 1, 1e-12);
  }
}

TEST(FlatRing, DelaunayTakesTheShortDiagonalOfAKite) {
  const std::vector<PlanePoint> kite = {{3, 0}, {0, 1}, {-3, 0}, {0, -1}};
  const std::vector<RingTriangle> triangles = delaunay_of_polygon(kite);
  ASSERT_EQ(triangles.size(), 2u);
  for (const RingTriangle& t : triangles) {
    EXPECT_EQ(std::count(t.begin(), t.end(), 1u) + std::count(t.begin(), t.end(), 3u), 2);
  }
}

TEST(FlatRing, DelaunayFillsAPolygonThatIsNotConvex) {
  // An arrow head: the corner at 2 sees all others.
  const std::vector<PlanePoint> arrow = {{0, 2}, {-2, -2}, {0, -1}, {2, -2}};
  double area = 0;
  const std::vector<RingTriangle> triangles = delaunay_of_polygon(arrow);
  for (const auto& [a, b, c] : triangles) {
    EXPECT_GT(doubled_area(arrow[a], arrow[b], arrow[c]), 0);
    area += doubled_area(arrow[a], arrow[b], arrow[c]) / 2;
  }
  EXPECT_EQ(triangles.size(), 2u);
  EXPECT_NEAR(area, 6, 1e-12);
}

TEST(FlatRing, AFanThatWouldTurnATriangleOverIsNone) {
  const std::vector<PlanePoint> arrow = {{0, 2}, {-2, -2}, {0, -1}, {2, -2}};
  EXPECT_TRUE(fan_of_polygon(arrow, 1).empty());
  EXPECT_EQ(fan_of_polygon(arrow, 2).size(), 2u);
}

TEST(FlatRing, APointBesideAllTrianglesIsPlacedInTheNearest) {
  const std::vector<std::array<PlanePoint, 3>> triangles = {{{{0, 0}, {1, 0}, {0, 1}}},
                                                            {{{5, 0}, {6, 0}, {5, 1}}}};
  const PlaneLocation location = locate({0.5, -1e-9}, triangles);
  EXPECT_EQ(location.triangle, 0u);
  EXPECT_NEAR(location.weights[0], 0.5, 1e-6);
  EXPECT_NEAR(location.weights[1], 0.5, 1e-6);
  EXPECT_EQ(location.weights[2], 0);
  EXPECT_DOUBLE_EQ(std::accumulate(location.weights.begin(), location.weights.end(), 0.0), 1);
}

}  // namespace
}  // namespace tvg
