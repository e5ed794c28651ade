#include "metrics/hausdorff.hpp"

#include "metrics/point_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace tvg {
namespace {

using Eigen::Vector3d;

class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed) : engine_(seed) {}

  double uniform() { return static_cast<double>(engine_()) / 4294967296.0; }
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(engine_()) % bound; }
  Vector3d in_cube(double half) {
    return half * Vector3d(2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1);
  }

 private:
  std::mt19937 engine_;
};

struct TestMesh {
  std::vector<Face> faces;
  Points points;
};

/// The square [0, 1]^2 in the plane z = 0.
TestMesh plane(std::uint32_t cells) {
  TestMesh mesh;
  for (std::uint32_t i = 0; i <= cells; ++i) {
    for (std::uint32_t j = 0; j <= cells; ++j) {
      mesh.points.emplace_back(static_cast<double>(i) / cells, static_cast<double>(j) / cells, 0);
    }
  }
  const std::uint32_t row = cells + 1;
  for (std::uint32_t i = 0; i < cells; ++i) {
    for (std::uint32_t j = 0; j < cells; ++j) {
      const std::uint32_t a = i * row + j;
      mesh.faces.push_back({a, a + row, a + row + 1});
      mesh.faces.push_back({a, a + row + 1, a + 1});
    }
  }
  return mesh;
}

Points shifted(Points points, const Vector3d& by) {
  for (Vector3d& p : points) p += by;
  return points;
}

double brute_force(const std::vector<Face>& faces, const Points& from, const Points& to) {
  Points samples;
  for (const Face& face : faces) {
    for (const std::uint32_t v : face) samples.push_back(from[v]);
    samples.emplace_back((from[face[0]] + from[face[1]] + from[face[2]]) / 3);
  }
  double largest = 0;
  for (const Vector3d& sample : samples) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : faces) {
      nearest = std::min(nearest, (sample - nearest_on_triangle(sample, to[a], to[b], to[c])).norm());
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST(NearestOnTriangle, KnowsEveryRegion) {
  const Vector3d a(0, 0, 0);
  const Vector3d b(2, 0, 0);
  const Vector3d c(0, 2, 0);
  struct Case {
    Vector3d point, nearest;
  };
  const std::vector<Case> cases = {
      {{0.5, 0.5, 3}, {0.5, 0.5, 0}},     // above the inside
      {{-1, -1, 1}, {0, 0, 0}},           // corner a
      {{4, -1, 0}, {2, 0, 0}},            // corner b
      {{-0.5, 5, 2}, {0, 2, 0}},          // corner c
      {{1, -2, 1}, {1, 0, 0}},            // edge ab
      {{-3, 0.5, 0}, {0, 0.5, 0}},        // edge ca
      {{2, 2, -1}, {1, 1, 0}},            // edge bc
      {{0.25, 0.25, 0}, {0.25, 0.25, 0}}  // on it
  };
  for (const Case& each : cases) {
    EXPECT_LT((nearest_on_triangle(each.point, a, b, c) - each.nearest).norm(), 1e-12)
        << each.point.transpose();
    EXPECT_LT((nearest_on_triangle(each.point, a, c, b) - each.nearest).norm(), 1e-12)
        << each.point.transpose();
  }
}

TEST(NearestOnTriangle, TreatsTrianglesWithoutAreaAsSegmentsAndPoints) {
  const Vector3d point(1, 2, 0);
  const Vector3d a(0, 0, 0);
  const Vector3d b(4, 0, 0);
  EXPECT_EQ(nearest_on_triangle(point, a, b, b), Vector3d(1, 0, 0));
  EXPECT_EQ(nearest_on_triangle(point, a, Vector3d(2, 0, 0), b), Vector3d(1, 0, 0));
  EXPECT_EQ(nearest_on_triangle(point, b, b, b), b);
}

TEST(NearestOnTriangle, NoPointOfTheTriangleIsNearer) {
  RandomPoints random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d a = random.in_cube(1);
    const Vector3d b = random.in_cube(1);
    const Vector3d c = random.in_cube(1);
    const Vector3d point = random.in_cube(2);
    const double distance = (point - nearest_on_triangle(point, a, b, c)).norm();
    double sampled = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 40; ++i) {
      for (int j = 0; i + j <= 40; ++j) {
        const Vector3d on = a + i / 40.0 * (b - a) + j / 40.0 * (c - a);
        sampled = std::min(sampled, (point - on).norm());
      }
    }
    EXPECT_LE(distance, sampled + 1e-12);
    EXPECT_GE(distance, sampled - 0.1);  // the samples are at most 2 sqrt(3) / 40 apart
  }
}

TEST(Hausdorff, OfASurfaceAndItselfIsZero) {
  const TestMesh mesh = plane(6);
  EXPECT_EQ(directed_hausdorff(mesh.faces, mesh.points, mesh.points), 0);
}

TEST(Hausdorff, OfAShiftedPlaneIsTheShift) {
  const TestMesh mesh = plane(8);
  const Points above = shifted(mesh.points, {0, 0, 0.375});
  EXPECT_DOUBLE_EQ(directed_hausdorff(mesh.faces, mesh.points, above), 0.375);
  EXPECT_DOUBLE_EQ(directed_hausdorff(mesh.faces, above, mesh.points), 0.375);
}

TEST(Hausdorff, SlidingWithinTheSurfaceCountsOnlyAtTheBorder) {
  const TestMesh mesh = plane(8);
  // Vertices move by 0.05, but only inside: the surface stays the same.
  Points slid = mesh.points;
  for (Vector3d& p : slid) {
    const bool inside = p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1;
    if (inside) p.x() += 0.05;
  }
  EXPECT_LT(directed_hausdorff(mesh.faces, mesh.points, slid), 1e-12);
  EXPECT_NEAR(directed_hausdorff(mesh.faces, mesh.points, shifted(mesh.points, {0.05, 0, 0})), 0.05, 1e-12);
}

TEST(Hausdorff, IsolatedVerticesAreNoPartOfTheSurface) {
  TestMesh mesh = plane(2);
  mesh.points.emplace_back(0, 0, 0);
  Points other = mesh.points;
  other.back() = Vector3d(100, 0, 0);
  EXPECT_EQ(directed_hausdorff(mesh.faces, mesh.points, other), 0);
  EXPECT_EQ(directed_hausdorff(mesh.faces, other, mesh.points), 0);
}

TEST(Hausdorff, EqualsBruteForceOnDisturbedSurfaces) {
  RandomPoints random(3);
  for (const double noise : {0.01, 0.1, 1.0}) {
    TestMesh mesh = plane(9);
    for (Vector3d& p : mesh.points) p.z() = 0.3 * std::sin(5 * p.x()) * p.y();
    Points other = mesh.points;
    for (Vector3d& p : other) p += random.in_cube(noise);
    EXPECT_DOUBLE_EQ(directed_hausdorff(mesh.faces, mesh.points, other),
                     brute_force(mesh.faces, mesh.points, other));
    EXPECT_DOUBLE_EQ(directed_hausdorff(mesh.faces, other, mesh.points),
                     brute_force(mesh.faces, other, mesh.points));
  }
}

TEST(Hausdorff, EqualsBruteForceOnSoupsOfVeryUnequalTriangles) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    RandomPoints random(seed);
    TestMesh soup;
    // Triangles from a thousandth of the whole to the whole, some without area, and far from the origin.
    const Vector3d away = seed % 2 == 0 ? Vector3d(0, 0, 0) : Vector3d(1000, -500, 200);
    for (std::uint32_t t = 0; t < 60; ++t) {
      const Vector3d centre = away + random.in_cube(1);
      const double size = std::pow(10.0, -3 * random.uniform());
      const auto first = static_cast<std::uint32_t>(soup.points.size());
      for (int k = 0; k < 3; ++k) soup.points.push_back(centre + random.in_cube(size));
      soup.faces.push_back({first, first + 1, t % 10 == 0 ? first : first + 2});
      if (t > 0) soup.faces.push_back({first, random.below(first), random.below(first)});
    }
    Points other = soup.points;
    for (Vector3d& p : other) p += random.in_cube(seed % 3 == 0 ? 0.02 : 0.7);
    EXPECT_NEAR(directed_hausdorff(soup.faces, soup.points, other),
                brute_force(soup.faces, soup.points, other), 1e-12);
    EXPECT_NEAR(directed_hausdorff(soup.faces, other, soup.points),
                brute_force(soup.faces, other, soup.points), 1e-12);
  }
}

}  // namespace
}  // namespace tvg
