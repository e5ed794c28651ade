#include "prediction/pyramid.hpp"

#include "prediction/pyramid_weights.hpp"
#include "tests/corruption/memory_meter.hpp"
#include "tests/prediction/pyramid_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace tvg {
namespace {

using test::ShapedMesh;

constexpr int kOne = 1 << kPyramidWeightBits;

Pyramid pyramid_of(const ShapedMesh& shaped, std::uint32_t neighbours = kMaxPyramidNeighbours) {
  Result<Pyramid> pyramid =
      build_pyramid(shaped.mesh.faces, shaped.mesh.vertex_count, shaped.shape, neighbours);
  EXPECT_TRUE(pyramid);
  return std::move(*pyramid);
}

/// What holds of the pyramid of any mesh.
void expect_sound(const ShapedMesh& shaped, std::uint32_t m) {
  const std::uint32_t count = shaped.mesh.vertex_count;
  const Pyramid p = pyramid_of(shaped, m);
  EXPECT_EQ(p.neighbours, m);
  ASSERT_EQ(p.order.size(), count);
  ASSERT_EQ(p.level.size(), count);
  ASSERT_EQ(p.count.size(), count);
  ASSERT_EQ(p.neighbour.size(), std::size_t{count} * m);
  ASSERT_EQ(p.weight.size(), std::size_t{count} * m);
  EXPECT_TRUE(std::is_sorted(p.level.begin(), p.level.end()));
  EXPECT_EQ(p.levels, count == 0 ? 0u : p.level.back() + 1u);
  std::vector<bool> had(count);
  for (std::size_t turn = 0; turn < count; ++turn) {
    const std::uint32_t v = p.order[turn], n = p.count[turn];
    ASSERT_LT(v, count);
    ASSERT_FALSE(had[v]) << "vertex " << v << " has two turns";
    ASSERT_LE(n, m);
    int sum = 0;
    for (std::size_t i = 0; i < m; ++i) {
      const std::uint32_t neighbour = p.neighbour[turn * m + i];
      sum += p.weight[turn * m + i];
      if (i < n) {
        ASSERT_LT(neighbour, count);
        ASSERT_TRUE(had[neighbour]) << "turn " << turn;
        for (std::size_t j = 0; j < i; ++j) ASSERT_NE(neighbour, p.neighbour[turn * m + j]);
      } else {
        ASSERT_EQ(neighbour, 0u);
        ASSERT_EQ(p.weight[turn * m + i], 0);
      }
    }
    ASSERT_EQ(sum, n == 0 ? 0 : kOne);
    ASSERT_EQ(n == 0, turn == 0) << "everything hangs together, so only the first has nothing to go by";
    had[v] = true;
  }
}

std::uint64_t hash_of(const Pyramid& p) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  const auto mix = [&hash](const auto& values) {
    for (const auto value : values) hash = (hash ^ static_cast<std::uint32_t>(value)) * 0x100000001B3u;
  };
  mix(p.order), mix(p.level), mix(p.count), mix(p.neighbour), mix(p.weight);
  return hash;
}

/// How far the weights of a turn miss its vertex, in units of the mean distance of its neighbours.
double miss(const Pyramid& p, const ShapedMesh& shaped, std::size_t turn) {
  std::array<double, 3> off{};
  double distance = 0;
  const auto& at = shaped.shape[p.order[turn]];
  for (std::size_t i = turn * p.neighbours; i < turn * p.neighbours + p.count[turn]; ++i) {
    const auto& from = shaped.shape[p.neighbour[i]];
    for (std::size_t k = 0; k < 3; ++k) off[k] += static_cast<double>(p.weight[i]) / kOne * (from[k] - at[k]);
    distance += std::hypot(from[0] - at[0], from[1] - at[1], from[2] - at[2]) / p.count[turn];
  }
  return std::hypot(off[0], off[1], off[2]) / distance;
}

TEST(Pyramid, GivesEachVertexOneTurnAfterItsNeighbours) {
  for (const std::uint32_t m : {4u, 8u, 11u, 16u}) {
    expect_sound(test::sheet(40), m);
    expect_sound(test::medley(), m);
  }
}

TEST(Pyramid, HoldsForMeshesOfAnyShape) {
  expect_sound({}, 16);
  for (std::uint32_t side = 1; side < 9; ++side) expect_sound(test::sheet(side), 8);
  expect_sound(test::soup(3000), 16);
  expect_sound(test::torn_sheet(30), 16);
  expect_sound(test::hub(100000, true), 8);
  expect_sound(test::hub(50000, false), 8);
}

TEST(Pyramid, HoldsWhereFacesSayNothing) {
  ShapedMesh points = test::sheet(30);
  points.mesh.faces.clear();
  expect_sound(points, 16);
  for (std::uint32_t v = 0; v < points.mesh.vertex_count; ++v) points.mesh.faces.push_back({v, v, v});
  expect_sound(points, 16);
  points.mesh.faces.assign(100000, {3, 500, 3});
  expect_sound(points, 16);
  ShapedMesh complete;  // every two vertices share a face
  for (int i = 0; i < 120; ++i) complete.add({i * i, 7 * i, i % 9});
  for (std::uint32_t a = 0; a < 120; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) complete.mesh.faces.push_back({a, b, (a + b) % 120});
  }
  expect_sound(complete, 16);
}

TEST(Pyramid, HoldsWhereTheShapeSaysNothing) {
  for (ShapedMesh shaped : {test::sheet(60), test::soup(500), test::hub(3000, true)}) {
    for (auto& point : shaped.shape) point = {77, -1, 0};
    expect_sound(shaped, 16);
  }
}

TEST(Pyramid, HoldsAtTheEndsOfTheRange) {
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min(),
                         kMost = std::numeric_limits<std::int32_t>::max();
  ShapedMesh shaped = test::sheet(40);
  test::Noise noise;
  for (auto& point : shaped.shape) {
    for (std::int32_t& x : point) x = noise.below(2) == 0 ? kLeast : kMost;
  }
  expect_sound(shaped, 16);
}

TEST(Pyramid, IsAPyramid) {
  const ShapedMesh shaped = test::sheet(100);
  const Pyramid p = pyramid_of(shaped);
  std::vector<std::size_t> sizes(p.levels);
  for (const std::uint8_t level : p.level) ++sizes[level];
  EXPECT_LE(sizes[0], 32u);
  for (std::size_t level = 2; level < sizes.size(); ++level) EXPECT_GT(sizes[level], 2 * sizes[level - 1]);
}

TEST(Pyramid, PutsAVertexThatManySurroundAtTheTop) {
  const Pyramid p = pyramid_of(test::hub(5000, true));
  const auto turn = std::find(p.order.begin(), p.order.end(), 0u) - p.order.begin();
  EXPECT_EQ(p.level[static_cast<std::size_t>(turn)], 0);
}

TEST(Pyramid, TakesNeighboursAlongTheSurface) {
  // Two sheets a unit apart, joined nowhere: what is near in space but not on the surface is left alone.
  ShapedMesh shaped = test::sheet(40);
  const ShapedMesh lower = shaped;
  for (const auto& p : lower.shape) shaped.add({p[0], p[1], p[2] - 1});
  for (const Face& f : lower.mesh.faces) shaped.mesh.faces.push_back({f[0] + 1600, f[1] + 1600, f[2] + 1600});
  const Pyramid p = pyramid_of(shaped);
  std::size_t across = 0;
  for (std::size_t turn = 64; turn < p.order.size(); ++turn) {
    for (std::size_t i = turn * 16; i < turn * 16 + p.count[turn]; ++i)
      across += (p.order[turn] < 1600) != (p.neighbour[i] < 1600) ? 1u : 0u;
  }
  EXPECT_LT(across, p.order.size() / 20);
}

TEST(Pyramid, TakesTheVertexAtTheSamePointWhereFacesShareNone) {
  const ShapedMesh shaped = test::torn_sheet(30);
  const Pyramid p = pyramid_of(shaped);
  std::size_t followed = 0;
  for (std::size_t turn = 0; turn < p.order.size(); ++turn) {
    if (p.count[turn] == 0) continue;
    followed += shaped.shape[p.neighbour[turn * 16]] == shaped.shape[p.order[turn]] ? 1u : 0u;
  }
  // All of the copies but one for each vertex of the whole sheet, less some whose copies come in one set.
  EXPECT_GT(followed, (p.order.size() - 900) * 95 / 100);
}

TEST(Pyramid, WeightsMeetAffineFunctions) {
  const ShapedMesh shaped = test::sheet(60);
  for (const std::uint32_t m : {8u, 16u}) {
    const Pyramid p = pyramid_of(shaped, m);
    double sum = 0;
    for (std::size_t turn = 100; turn < p.order.size(); ++turn) {
      ASSERT_EQ(p.count[turn], m);
      const double missed = miss(p, shaped, turn);
      sum += missed;
      // Few neighbours may lie in a plane that the vertex is not in.
      EXPECT_LT(missed, m == 16 ? 0.005 : 0.5) << "turn " << turn;
    }
    EXPECT_LT(sum / static_cast<double>(p.order.size()), 0.002);
  }
}

TEST(Pyramid, IsTheSameOnEveryMachine) {
  EXPECT_EQ(hash_of(pyramid_of(test::medley(), 16)), 2529728595349551097u);
  EXPECT_EQ(hash_of(pyramid_of(test::medley(), 8)), 17236968200144549138u);
  EXPECT_EQ(hash_of(pyramid_of(test::sheet(60), 16)), 14239245415502075752u);
}

TEST(Pyramid, StaysWithinTheMemoryItPromises) {
  for (const ShapedMesh& shaped : {test::sheet(150), test::soup(8000), test::torn_sheet(40),
                                   test::hub(20000, true), test::hub(20000, false)}) {
    const corruption::MemoryMeter meter;
    const Pyramid p = pyramid_of(shaped);
    const std::size_t result = p.order.size() * (4 + 1 + 1 + 16 * (4 + 2));
    EXPECT_LE(meter.peak(),
              result + 96 * std::size_t{shaped.mesh.vertex_count} + 96 * shaped.mesh.faces.size() + 65536);
  }
}

/// Levels without a thought to the mesh, `count` of them, of which each has a vertex.
std::vector<std::uint8_t> some_levels(std::uint32_t vertices, std::uint32_t count) {
  test::Noise noise;
  std::vector<std::uint8_t> levels;
  for (std::uint32_t v = 0; v < vertices; ++v)
    levels.push_back(
        static_cast<std::uint8_t>(v < count ? v : static_cast<std::uint32_t>(noise.below(count))));
  return levels;
}

Pyramid pyramid_of(const ShapedMesh& shaped, const std::vector<std::uint8_t>& levels) {
  Result<Pyramid> pyramid =
      build_pyramid(shaped.mesh.faces, shaped.mesh.vertex_count, shaped.shape, 12, levels);
  EXPECT_TRUE(pyramid);
  return std::move(*pyramid);
}

TEST(PyramidOfLevels, HasTheVerticesOfLowerLevelsFirstWhateverTheLevels) {
  for (const ShapedMesh& shaped : {test::sheet(40), test::medley(), test::soup(300), test::hub(3000, true)}) {
    for (const std::uint32_t count : {1u, 2u, 3u, 9u, 64u}) {
      const std::vector<std::uint8_t> levels = some_levels(shaped.mesh.vertex_count, count);
      const Pyramid p = pyramid_of(shaped, levels);
      ASSERT_EQ(p.order.size(), levels.size());
      EXPECT_TRUE(std::is_sorted(p.level.begin(), p.level.end()));
      EXPECT_LE(p.levels, 49 + count - 1);
      std::vector<bool> had(levels.size());
      for (std::size_t turn = 0; turn < p.order.size(); ++turn) {
        if (turn > 0) {
          const std::uint8_t before = levels[p.order[turn - 1]], now = levels[p.order[turn]];
          ASSERT_GE(now, before);
          ASSERT_TRUE(now == before || p.level[turn] != p.level[turn - 1]);
        }
        for (std::size_t i = turn * 12; i < turn * 12 + p.count[turn]; ++i) ASSERT_TRUE(had[p.neighbour[i]]);
        ASSERT_FALSE(had[p.order[turn]]);
        had[p.order[turn]] = true;
      }
    }
  }
}

TEST(PyramidOfLevels, IsThePyramidItselfWhereThereIsOneLevel) {
  const ShapedMesh shaped = test::medley();
  EXPECT_EQ(hash_of(pyramid_of(shaped, some_levels(shaped.mesh.vertex_count, 1))),
            hash_of(pyramid_of(shaped, 12u)));
}

TEST(PyramidOfLevels, HoldsWhereAllButOneVertexGoAtOnce) {
  const ShapedMesh shaped = test::sheet(60);
  std::vector<std::uint8_t> levels(shaped.mesh.vertex_count, 1);
  levels[17] = 0;
  const Pyramid p = pyramid_of(shaped, levels);
  EXPECT_EQ(p.order.front(), 17u);
  EXPECT_EQ(p.levels, 2u);
}

TEST(PyramidOfLevels, StaysWithinTheMemoryItPromises) {
  for (const ShapedMesh& shaped :
       {test::sheet(150), test::soup(8000), test::hub(20000, true), test::hub(20000, false)}) {
    for (const std::uint32_t count : {2u, 7u, 64u}) {
      const std::vector<std::uint8_t> levels = some_levels(shaped.mesh.vertex_count, count);
      const corruption::MemoryMeter meter;
      const Pyramid p = pyramid_of(shaped, levels);
      const std::size_t result = p.order.size() * (4 + 1 + 1 + 12 * (4 + 2));
      EXPECT_LE(meter.peak(),
                result + 96 * std::size_t{shaped.mesh.vertex_count} + 96 * shaped.mesh.faces.size() + 65536);
    }
  }
}

TEST(PyramidOfLevels, IsTheSameOnEveryMachine) {
  const ShapedMesh shaped = test::medley();
  EXPECT_EQ(hash_of(pyramid_of(shaped, some_levels(shaped.mesh.vertex_count, 5))), 6378973407516348405u);
}

TEST(Pyramid, SaysWhenThereIsNoMemory) {
  const ShapedMesh shaped = test::sheet(100);
  std::size_t peak = 0;
  {
    const corruption::MemoryMeter meter;
    pyramid_of(shaped);
    peak = meter.peak();
  }
  for (std::size_t percent = 0; percent < 100; percent += 3) {
    const corruption::MemoryMeter meter(peak * percent / 100);
    const Result<Pyramid> pyramid =
        build_pyramid(shaped.mesh.faces, shaped.mesh.vertex_count, shaped.shape, 16);
    ASSERT_FALSE(pyramid) << percent << " % of what is needed";
    EXPECT_EQ(pyramid.error().code, ErrorCode::kOutOfMemory);
  }
}

std::vector<std::int16_t> weights_of(const ShapePoint& point, const std::vector<ShapePoint>& around) {
  std::vector<std::int16_t> weights(around.size());
  krige(point, around, weights);
  return weights;
}

TEST(PyramidWeights, AreHalfAndHalfInTheMiddle) {
  EXPECT_EQ(weights_of({5, 0, 0}, {{0, 0, 0}, {10, 0, 0}}), (std::vector<std::int16_t>{kOne / 2, kOne / 2}));
}

TEST(PyramidWeights, AreEvenWherePointsCoincide) {
  EXPECT_EQ(weights_of({1, 1, 1}, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}),
            std::vector<std::int16_t>(4, kOne / 4));
}

TEST(PyramidWeights, TakeThePointItselfWhereItIsThere) {
  const std::vector<std::int16_t> weights =
      weights_of({0, 0, 0}, {{0, 0, 0}, {100, 0, 5}, {0, 100, 7}, {-90, -80, 3}, {60, -70, 90}});
  EXPECT_NEAR(weights[0], kOne, 32);
}

TEST(PyramidWeights, StayWithinTheirBoundsFarOutside) {
  for (std::int32_t far = 1; far < 1 << 24; far *= 2) {
    const std::vector<std::int16_t> weights =
        weights_of({far, 0, 0}, {{0, 0, 0}, {-1, 0, 0}, {-2, 1, 0}, {-3, 0, 1}, {-1, 1, 1}});
    EXPECT_EQ(std::accumulate(weights.begin(), weights.end(), 0), kOne);
    for (const int weight : weights) EXPECT_LT(std::abs(weight), 2 * kOne);
  }
}

}  // namespace
}  // namespace tvg
