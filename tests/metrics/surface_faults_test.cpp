#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include <tvg/metrics.hpp>

namespace tvg {
namespace {

SurfaceFaults faults(const Mesh& mesh, const std::vector<float>& positions, double fold = 150) {
  const Result<SurfaceFaults> result = surface_faults(mesh, positions, fold);
  EXPECT_TRUE(result);
  return result ? *result : SurfaceFaults{};
}

/// Two triangles over the edge from (0, 0, 0) to (0, 1, 0), the second turned up from the first by an angle.
std::vector<float> book(double degrees) {
  const double angle = degrees * 3.14159265358979 / 180;
  return {0,  0,
          0,  0,
          1,  0,
          -1, 0,
          0,  static_cast<float>(std::cos(angle)),
          0,  static_cast<float>(std::sin(angle))};
}

const Mesh kBook{4, {{0, 1, 2}, {1, 0, 3}}};

TEST(SurfaceFaults, AFoldIsCountedBeyondTheAngle) {
  EXPECT_EQ(faults(kBook, book(0)), (SurfaceFaults{0, 0}));
  EXPECT_EQ(faults(kBook, book(149)).folds, 0U);
  EXPECT_EQ(faults(kBook, book(151)).folds, 1U);
  EXPECT_EQ(faults(kBook, book(-151)).folds, 1U);
  EXPECT_EQ(faults(kBook, book(91), 90).folds, 1U);
  EXPECT_EQ(faults(kBook, book(180)).folds, 1U);
}

TEST(SurfaceFaults, WhichWayRoundFacesAreTurnedMakesNoFold) {
  const Mesh turned{4, {{0, 1, 2}, {0, 1, 3}}};
  EXPECT_EQ(faults(turned, book(0)).folds, 0U);
  EXPECT_EQ(faults(turned, book(170)).folds, 1U);
}

TEST(SurfaceFaults, EdgesOfMoreFacesAndFacesWithoutAreaAreNoFolds) {
  std::vector<float> positions = book(180);
  positions.insert(positions.end(), {0, 0, 1});
  EXPECT_EQ(faults({5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}, positions).folds, 0U);
  EXPECT_EQ(faults({4, {{0, 1, 2}, {1, 0, 0}}}, book(180)).folds, 0U);
}

TEST(SurfaceFaults, FacesThatPassThroughEachOtherIntersect) {
  const Mesh two{6, {{0, 1, 2}, {3, 4, 5}}};
  const std::vector<float> through = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5, 0.5, -1, 0.5, 0.5, 1, 5, 5, 0};
  EXPECT_EQ(faults(two, through), (SurfaceFaults{1, 0}));
  std::vector<float> beside = through;
  for (std::size_t v = 3; v < 6; ++v) beside[3 * v] += 9;
  EXPECT_EQ(faults(two, beside), (SurfaceFaults{0, 0}));
}

TEST(SurfaceFaults, FacesThatTouchOrLieInOnePlaneDoNotIntersect) {
  const Mesh two{6, {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_EQ(faults(two, {0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5, 0.5, 0, 0.5, 0.5, 1, 5, 5, 1}).intersections, 0U);
  EXPECT_EQ(faults(two, {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 2, 0}).intersections, 0U);
}

TEST(SurfaceFaults, NeighboursAtAVertexIntersectOnlyBeyondIt) {
  const Mesh fan{5, {{0, 1, 2}, {0, 3, 4}}};
  EXPECT_EQ(faults(fan, {0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 1, -1, 1, 1, 1}).intersections, 1U);
  EXPECT_EQ(faults(fan, {0, 0, 0, 2, 0, 0, 0, 2, 0, -1, -1, -1, -1, -1, 1}).intersections, 0U);
  EXPECT_EQ(faults(kBook, book(175)).intersections, 0U);
}

/// Triangles all over the unit cube, a few of them without area.
std::vector<float> soup(std::size_t triangles, unsigned seed) {
  std::mt19937 engine(seed);
  std::vector<float> positions;
  for (std::size_t t = 0; t < triangles; ++t) {
    float at[3];
    for (float& each : at) each = static_cast<float>(engine() % 1000) / 1000;
    for (int corner = 0; corner < 3; ++corner) {
      for (const float each : at) positions.push_back(each + static_cast<float>(engine() % 1000) / 4000);
    }
  }
  return positions;
}

TEST(SurfaceFaults, FindsEveryPairThatPairsAloneFind) {
  constexpr std::uint32_t kTriangles = 150;
  const std::vector<float> positions = soup(kTriangles, 5);
  Mesh mesh{3 * kTriangles, {}};
  for (std::uint32_t t = 0; t < kTriangles; ++t) mesh.faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  std::uint64_t expected = 0;
  for (std::uint32_t a = 0; a < kTriangles; ++a) {
    for (std::uint32_t b = a + 1; b < kTriangles; ++b) {
      const Mesh pair{mesh.vertex_count, {mesh.faces[a], mesh.faces[b]}};
      expected += faults(pair, positions).intersections;
    }
  }
  EXPECT_GT(expected, 20U);
  EXPECT_EQ(faults(mesh, positions).intersections, expected);
}

TEST(SurfaceFaults, RefusesWhatIsNoMeshOrNoAngle) {
  const auto code = [](const Mesh& mesh, const std::vector<float>& positions, double fold) {
    const Result<SurfaceFaults> result = surface_faults(mesh, positions, fold);
    EXPECT_FALSE(result);
    return result ? ErrorCode::kIo : result.error().code;
  };
  EXPECT_EQ(code(kBook, book(0), 181), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(kBook, book(0), NAN), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(kBook, std::vector<float>(9), 90), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(kBook, std::vector<float>(12, INFINITY), 90), ErrorCode::kInvalidInput);
  EXPECT_EQ(code({4, {{0, 1, 4}}}, book(0), 90), ErrorCode::kInvalidInput);
  EXPECT_EQ(faults({0, {}}, {}), (SurfaceFaults{0, 0}));
}

}  // namespace
}  // namespace tvg
