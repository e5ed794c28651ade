#include "geometry/topology.hpp"

#include "tests/connectivity/mesh_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>
#include <thread>
#include <vector>

namespace tvg {
namespace {

using testing::Each;
using testing::ElementsAre;

std::vector<std::uint8_t> closed_fans_of(const Mesh& mesh) {
  return Topology(mesh).closed_fans();
}

TEST(ClosedFans, AreEveryVertexOfAClosedSurface) {
  EXPECT_THAT(closed_fans_of(test::tetrahedron()), Each(1));
  EXPECT_THAT(closed_fans_of(test::grid(5, 4, true, true)), Each(1));
}

TEST(ClosedFans, AreNoneAtABorder) {
  const Mesh mesh = test::grid(3, 3);
  const std::vector<std::uint8_t> closed = closed_fans_of(mesh);
  EXPECT_EQ(std::accumulate(closed.begin(), closed.end(), 0), 4) << "of 16 vertices, those inside";
  EXPECT_EQ(closed[5], 1);
}

TEST(ClosedFans, AreNoneWhereSurfacesTouchOrFacesRunTheOtherWay) {
  // Two tetrahedra that share vertex 0.
  Mesh twice = test::tetrahedron();
  twice.vertex_count = 7;
  for (const Face& face : test::tetrahedron().faces) {
    Face moved = face;
    for (std::uint32_t& v : moved) v = v == 0 ? 0 : v + 3;
    twice.faces.push_back(moved);
  }
  EXPECT_THAT(closed_fans_of(twice), ElementsAre(0, 1, 1, 1, 1, 1, 1));

  Mesh flipped = test::tetrahedron();
  std::swap(flipped.faces[0][0], flipped.faces[0][1]);
  EXPECT_EQ(closed_fans_of(flipped)[flipped.faces[0][0]], 0);
  Mesh with_degenerate = test::tetrahedron();
  with_degenerate.faces.push_back({1, 1, 2});
  EXPECT_THAT(closed_fans_of(with_degenerate), Each(1)) << "a face with a vertex twice is left out";
}

TEST(Topology, IsMadeOnceForSeveralThreads) {
  const Mesh mesh = test::grid(40, 40, true, true);
  const Topology topology(mesh);
  std::vector<const OneRings*> seen(4);
  std::vector<std::thread> threads;
  for (const OneRings*& rings : seen) {
    threads.emplace_back([&topology, &rings] {
      EXPECT_THAT(topology.closed_fans(), Each(1));
      rings = &topology.rings();
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(seen, Each(&topology.rings()));
}

}  // namespace
}  // namespace tvg
