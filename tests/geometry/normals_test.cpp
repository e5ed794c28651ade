#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <tvg/normals.hpp>

namespace {

std::vector<float> normals_of(const std::vector<tvg::Face>& faces, const std::vector<float>& positions) {
  std::vector<float> normals(positions.size(), 7.0f);
  tvg::vertex_normals(faces, positions, normals);
  return normals;
}

TEST(Normals, PointOutOfCounterClockwiseFaces) {
  const std::vector<float> normals = normals_of({{0, 1, 2}}, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  EXPECT_EQ(normals, (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}));
}

TEST(Normals, WeighFacesByTheirArea) {
  // At vertex 0 a face of area 2 looks along z and one of area 1/2 along x: (1, 0, 4) / sqrt(17).
  const std::vector<float> positions = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 1, 0, 0, 0, 1};
  const std::vector<float> normals = normals_of({{0, 1, 2}, {0, 3, 4}}, positions);
  EXPECT_FLOAT_EQ(normals[0], static_cast<float>(1 / std::sqrt(17.0)));
  EXPECT_FLOAT_EQ(normals[1], 0);
  EXPECT_FLOAT_EQ(normals[2], static_cast<float>(4 / std::sqrt(17.0)));
}

TEST(Normals, AreZeroWhereNoFaceHasAnArea) {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 2, 0, 0, 5, 5, 5};
  for (const float x : normals_of({{0, 1, 2}, {0, 0, 1}}, positions)) EXPECT_EQ(x, 0);
}

TEST(Normals, OfHugeMeshesAreStillUnitOrZero) {
  const float far = std::numeric_limits<float>::max();
  for (const float size : {1e-18f, 1e18f, far}) {
    const std::vector<float> normals = normals_of({{0, 1, 2}}, {0, 0, 0, size, 0, 0, 0, size, 0});
    for (std::size_t v = 0; v < 3; ++v) {
      EXPECT_TRUE(normals[3 * v + 2] == 1 || normals[3 * v + 2] == 0) << size;
      EXPECT_EQ(normals[3 * v], 0);
    }
  }
}

}  // namespace
