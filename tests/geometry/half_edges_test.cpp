#include "geometry/half_edges_encode.hpp"
#include "tests/connectivity/mesh_builders.hpp"

#include <algorithm>
#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

namespace tvg {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::Ne;

TEST(HalfEdgesByEdge, AreSortedByTheirEndsThenByNumber) {
  std::mt19937 random(3);
  for (const std::uint32_t vertices : {1u, 2u, 5u, 40u, 1000u}) {
    const Mesh mesh = test::random_soup(vertices, 300, random);
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> expected, found;
    for (std::uint32_t id = 0; id < 3 * mesh.faces.size(); ++id) {
      const Face& face = mesh.faces[id / 3];
      const std::uint32_t from = face[id % 3], to = face[(id % 3 + 1) % 3];
      if (from != to) expected.emplace_back(std::min(from, to), std::max(from, to), id);
    }
    std::sort(expected.begin(), expected.end());
    for (const HalfEdge& half_edge : half_edges_by_edge(mesh)) {
      found.emplace_back(half_edge.low, half_edge.high, half_edge.id);
    }
    EXPECT_EQ(found, expected) << vertices;
  }
}

TEST(PairHalfEdges, LeavesNoneAloneOnAClosedSurface) {
  EXPECT_THAT(pair_half_edges(test::tetrahedron()), Each(Ne(kNoHalfEdge)));
  EXPECT_THAT(pair_half_edges(test::grid(7, 5, true, true)), Each(Ne(kNoHalfEdge)));
}

TEST(PairHalfEdges, LeavesTheBorderAlone) {
  // The square 0 1 2 3, cut from 0 to 2.
  EXPECT_THAT(pair_half_edges(Mesh{4, {{0, 1, 2}, {0, 2, 3}}}),
              ElementsAre(kNoHalfEdge, kNoHalfEdge, 3, 2, kNoHalfEdge, kNoHalfEdge));
}

TEST(PairHalfEdges, PairsAsManyAsRunInOppositeDirectionsAndNoMore) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    const Mesh mesh = test::random_soup(12, 200, random);
    const std::vector<std::uint32_t> partner = pair_half_edges(mesh);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<std::uint32_t, 2>> sides;  // all, paired
    for (std::uint32_t id = 0; id < partner.size(); ++id) {
      const Face& face = mesh.faces[id / 3];
      const auto [from, to] = std::pair(face[id % 3], face[(id % 3 + 1) % 3]);
      if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) {
        EXPECT_EQ(partner[id], kNoHalfEdge) << "of a face with two equal corners";
        continue;
      }
      ++sides[{from, to}][0];
      if (partner[id] == kNoHalfEdge) continue;
      ++sides[{from, to}][1];
      EXPECT_EQ(partner[partner[id]], id);
      const Face& other = mesh.faces[partner[id] / 3];
      EXPECT_EQ(other[partner[id] % 3], to);
      EXPECT_EQ(other[(partner[id] % 3 + 1) % 3], from);
    }
    for (const auto& [edge, count] : sides) {
      const auto back = sides.find({edge.second, edge.first});
      const std::uint32_t most = back == sides.end() ? 0 : std::min(count[0], back->second[0]);
      EXPECT_EQ(count[1], most) << edge.first << "-" << edge.second;
    }
  }
}

TEST(PairHalfEdges, DoesNotPairAFaceWithItsOwnBackWhereItNeedNot) {
  const Mesh sheet = test::grid(3, 3, true, true);
  Mesh both = sheet;
  for (const Face& face : sheet.faces) both.faces.push_back({face[0], face[2], face[1]});
  const std::vector<std::uint32_t> partner = pair_half_edges(both);
  const auto faces = static_cast<std::uint32_t>(sheet.faces.size());
  for (std::uint32_t id = 0; id < 3 * faces; ++id) EXPECT_NE(partner[id] / 3, id / 3 + faces) << id;
}

}  // namespace
}  // namespace tvg
