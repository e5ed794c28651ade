#include "simplify/triangle_pair.hpp"

#include <gtest/gtest.h>

namespace tvg {
namespace {

using Eigen::Vector3d;

const SpaceTriangle kFloor = {{0, 1, 2}, {Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 4, 0)}};

SpaceTriangle other(std::array<std::uint32_t, 3> vertices, const Vector3d& a, const Vector3d& b,
                    const Vector3d& c) {
  return {vertices, {a, b, c}};
}

bool meet(const SpaceTriangle& triangle) {
  const bool forth = triangles_meet(kFloor, triangle);
  EXPECT_EQ(forth, triangles_meet(triangle, kFloor));
  return forth;
}

TEST(TrianglePair, OneThatPiercesAnotherMeetsIt) {
  EXPECT_TRUE(meet(other({3, 4, 5}, {1, 1, -1}, {1, 1, 1}, {9, 9, 1})));
  EXPECT_FALSE(meet(other({3, 4, 5}, {3, 3, -1}, {3, 3, 1}, {9, 9, 1})));
}

TEST(TrianglePair, TouchingIsNotMeeting) {
  EXPECT_FALSE(meet(other({3, 4, 5}, {1, 1, 0}, {1, 1, 1}, {9, 9, 1})));
  EXPECT_FALSE(meet(other({3, 4, 5}, {0, 0, 0}, {4, 0, 0}, {0, 0, 4})))
      << "an edge in common, by other vertices";
  EXPECT_FALSE(meet(other({3, 4, 5}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0})));
}

TEST(TrianglePair, OverlapInAPlaneIsMeeting) {
  EXPECT_TRUE(meet(other({3, 4, 5}, {1, 1, 0}, {2, 1, 0}, {1, 2, 0})));
  EXPECT_TRUE(meet(other({3, 4, 5}, {0, 0, 0}, {0, 4, 0}, {4, 0, 0}))) << "its own back";
  EXPECT_FALSE(meet(other({3, 4, 5}, {5, 5, 0}, {6, 5, 0}, {5, 6, 0})));
}

TEST(TrianglePair, NeighboursMeetOnlyWhereTheyFoldOrPierce) {
  EXPECT_FALSE(meet(other({0, 3, 4}, {0, 0, 0}, {-1, 0, 1}, {0, -1, 1})));
  EXPECT_TRUE(meet(other({0, 3, 4}, {0, 0, 0}, {1, 1, -1}, {1, 1.5, 1})));
  EXPECT_FALSE(meet(other({1, 0, 3}, {4, 0, 0}, {0, 0, 0}, {1, -3, 0})));
  EXPECT_TRUE(meet(other({1, 0, 3}, {4, 0, 0}, {0, 0, 0}, {1, 3, 0}))) << "folded over the common edge";
  EXPECT_FALSE(meet(other({1, 0, 3}, {4, 0, 0}, {0, 0, 0}, {1, 3, 0.1})));
}

TEST(TrianglePair, WithoutAnAreaNothingIsMet) {
  EXPECT_FALSE(meet(other({3, 4, 5}, {1, 1, -1}, {1, 1, 1}, {1, 1, 1})));
}

}  // namespace
}  // namespace tvg
