#include "corpus/corpus.hpp"
#include "simplify_toolbox.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <numeric>

namespace tvg {
namespace {

using test::down_to;

void expect_error(const Sequence& sequence, const SimplifyOptions& options, ErrorCode code) {
  const auto result = test::simplify(sequence, options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, code) << result.error().describe();
}

TEST(Simplify, EveryVertexHasItsPlaceNearWhereItWas) {
  const Sequence face = corpus::make_face({1000, 3});
  const auto result = test::simplify(face, down_to({400, 160}));
  ASSERT_TRUE(result);
  for (const SimplifiedMesh& simple : result->meshes) {
    ASSERT_EQ(simple.places.size(), face.mesh.vertex_count);
    for (const SurfacePlace& place : simple.places) {
      ASSERT_LT(place.face, simple.mesh.faces.size());
      for (const double weight : place.weights) EXPECT_GE(weight, 0);
      EXPECT_NEAR(std::accumulate(place.weights.begin(), place.weights.end(), 0.0), 1, 1e-12);
    }
    const double diagonal = box_around(face.frames).diagonal();
    const std::vector<FramePositions> frames = test::frames_of(simple, face.frames);
    std::vector<float> back(face.frames[0].size());
    for (std::size_t f = 0; f < frames.size(); ++f) {
      positions_of(simple.mesh, simple.places, frames[f], back);
      double sum = 0;
      for (std::size_t i = 0; i < back.size(); ++i) sum += std::pow(back[i] - face.frames[f][i], 2);
      EXPECT_LT(std::sqrt(sum / face.mesh.vertex_count), 0.02 * diagonal);
      for (const std::uint32_t v : simple.vertices) {
        for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) EXPECT_EQ(back[i], face.frames[f][i]);
      }
    }
  }
}

TEST(Simplify, LevelsAddUpAndEndWhereMeshesAreKept) {
  const Sequence hand = corpus::make_hand({1500, 2}).sequence;
  const auto result = test::simplify(hand, down_to({900, 500, 200}));
  ASSERT_TRUE(result);
  std::uint32_t left = hand.mesh.vertex_count;
  for (const SimplifyLevel& level : result->levels) {
    left -= level.removed;
    EXPECT_EQ(level.vertices, left);
    EXPECT_EQ(level.quadric_error.size(), hand.frames.size());
  }
  EXPECT_EQ(left, 200u);
  EXPECT_EQ(result->removed.size(), hand.mesh.vertex_count - left);

  const MeshLevels& levels = result->mesh_levels;
  ASSERT_EQ(levels.level.size(), hand.mesh.vertex_count);
  ASSERT_EQ(levels.coarse.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const SimplifiedMesh& simple = result->meshes[k];
    std::vector<std::uint32_t> below;
    for (std::uint32_t v = 0; v < levels.level.size(); ++v) {
      if (levels.level[v] < levels.coarse[k].levels) below.push_back(v);
    }
    EXPECT_EQ(below, simple.vertices);
    ASSERT_EQ(levels.coarse[k].faces.size(), simple.mesh.faces.size());
    for (std::size_t f = 0; f < simple.mesh.faces.size(); ++f) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(levels.coarse[k].faces[f][c], simple.vertices[simple.mesh.faces[f][c]]);
      }
    }
  }
  EXPECT_EQ(levels.coarse[2].levels, 1u);
}

TEST(Simplify, MoreLevelsThanVerticesCanHaveAreJoined) {
  const Sequence grid = test::flat_grid(12, 12);
  std::vector<std::uint32_t> counts;
  for (std::uint32_t count = 143; counts.size() < 63; count -= 2) counts.push_back(count);
  const auto result = test::simplify(grid, down_to(counts));
  ASSERT_TRUE(result) << result.error().describe();
  const auto highest = *std::max_element(result->mesh_levels.level.begin(), result->mesh_levels.level.end());
  EXPECT_LT(highest, kMaxVertexLevels);
  EXPECT_EQ(result->mesh_levels.coarse.size(), 63u);
  for (std::size_t k = 0; k + 1 < 63; ++k) {
    EXPECT_GT(result->mesh_levels.coarse[k].levels, result->mesh_levels.coarse[k + 1].levels);
  }
}

TEST(Simplify, TheSameComesOutEveryTime) {
  const Sequence cloth = corpus::make_cloth({800, 4});
  SimplifyOptions options = down_to({150});
  options.priority = SimplifyPriority::kMeasure;
  const auto once = test::simplify(cloth, options), again = test::simplify(cloth, options);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->meshes[0].mesh, again->meshes[0].mesh);
  EXPECT_EQ(once->removed, again->removed);
  for (std::size_t i = 0; i < once->meshes[0].places.size(); ++i) {
    EXPECT_EQ(once->meshes[0].places[i].face, again->meshes[0].places[i].face);
    EXPECT_EQ(once->meshes[0].places[i].weights, again->meshes[0].places[i].weights);
  }
}

TEST(Simplify, WhatTheMeasureFindsImportantStaysTheLongest) {
  Sequence grid = test::flat_grid(20, 20);
  SimplifyOptions options = down_to({130});
  options.priority = SimplifyPriority::kMeasure;
  options.importance.criteria = {{"weights", 1.0}};
  for (std::uint32_t v = 0; v < 400; ++v) options.importance.weights.push_back(v % 20 < 5 ? 1 : 0);
  const auto result = test::simplify(grid, options);
  ASSERT_TRUE(result) << result.error().describe();
  const auto kept = std::count_if(result->meshes[0].vertices.begin(), result->meshes[0].vertices.end(),
                                  [](std::uint32_t v) { return v % 20 < 5; });
  EXPECT_GT(kept, 36) << "by chance a quarter of 130 would be, which is 32";
}

TEST(Simplify, NothingIsRemovedWhereEnoughIsAsked) {
  const Sequence grid = test::flat_grid(4, 4);
  const auto result = test::simplify(grid, down_to({99, 16}));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->meshes[0].mesh, grid.mesh);
  EXPECT_EQ(result->meshes[1].mesh, grid.mesh);
  EXPECT_TRUE(result->levels.empty());
  EXPECT_TRUE(result->mesh_levels.coarse.empty());
}

TEST(Simplify, ProgressRisesToItsTotal) {
  const Sequence sphere = test::sphere(4);
  std::uint32_t last = 0, last_total = 0;
  const auto result =
      tvg::simplify(sphere.mesh, sphere.frames, {}, {}, down_to({100}), [&](auto removed, auto total) {
        EXPECT_GE(removed, last);
        EXPECT_LE(removed, total);
        last = removed;
        last_total = total;
      });
  ASSERT_TRUE(result);
  EXPECT_EQ(last, sphere.mesh.vertex_count - 100);
  EXPECT_EQ(last_total, last);
}

TEST(Simplify, OptionsOutOfRangeAreRefused) {
  const Sequence grid = test::flat_grid(4, 4);
  expect_error(grid, down_to({}), ErrorCode::kInvalidArgument);
  expect_error(grid, down_to({2}), ErrorCode::kInvalidArgument);
  expect_error(grid, down_to({8, 8}), ErrorCode::kInvalidArgument);
  SimplifyOptions options = down_to({8});
  options.lambda = 1.5;
  expect_error(grid, options, ErrorCode::kInvalidArgument);
  options = down_to({8});
  options.largest_turn = 181;
  expect_error(grid, options, ErrorCode::kInvalidArgument);
  options = down_to({8});
  options.priority = SimplifyPriority::kMeasure;
  options.importance.criteria = {{"skel", 1.0}};
  expect_error(grid, options, ErrorCode::kInvalidArgument);
}

TEST(Simplify, InputThatIsNoMeshInMotionIsRefused) {
  const Sequence good = test::flat_grid(4, 4);
  Sequence grid = good;
  grid.frames.clear();
  expect_error(grid, down_to({8}), ErrorCode::kInvalidArgument);
  grid = good;
  grid.frames[0].pop_back();
  expect_error(grid, down_to({8}), ErrorCode::kInvalidInput);
  grid = good;
  grid.frames[0][7] = std::numeric_limits<float>::quiet_NaN();
  expect_error(grid, down_to({8}), ErrorCode::kInvalidInput);
  grid = good;
  grid.mesh.faces[3][1] = 99;
  expect_error(grid, down_to({8}), ErrorCode::kInvalidInput);
  grid = good;
  std::fill(grid.frames[0].begin(), grid.frames[0].end(), 1.0f);
  expect_error(grid, down_to({8}), ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace tvg
