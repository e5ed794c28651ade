#include "corpus/corpus.hpp"
#include "simplify_toolbox.hpp"

#include <gtest/gtest.h>

#include <tvg/metrics.hpp>

namespace tvg {
namespace {

using Eigen::Vector3d;
using test::down_to;

/// A triangle and its points in one frame.
struct Placed {
  Face face;
  std::array<Vector3d, 3> points;
};

std::vector<Placed> placed(const Mesh& mesh, const FramePositions& frame) {
  std::vector<Placed> result;
  for (const Face& face : mesh.faces) {
    Placed& triangle = result.emplace_back();
    triangle.face = face;
    for (std::size_t c = 0; c < 3; ++c) {
      triangle.points[c] = Eigen::Map<const Eigen::Vector3f>(frame.data() + 3 * face[c]).cast<double>();
    }
  }
  return result;
}

/// Whether the segment runs through the inside of the triangle, well away from its sides and its own ends.
bool pierces(const Vector3d& from, const Vector3d& to, const Placed& triangle) {
  Eigen::Matrix3d columns;
  columns << triangle.points[1] - triangle.points[0], triangle.points[2] - triangle.points[0], from - to;
  if (std::abs(columns.determinant()) < 1e-14) return false;
  const Vector3d solved = columns.inverse() * (from - triangle.points[0]);
  constexpr double kMargin = 1e-4;
  return solved[0] > kMargin && solved[1] > kMargin && solved[0] + solved[1] < 1 - kMargin &&
         solved[2] > kMargin && solved[2] < 1 - kMargin;
}

/// Pairs of triangles of which a side of one pierces the other, every pair looked at.
std::size_t crossings(const Mesh& mesh, const FramePositions& frame) {
  const std::vector<Placed> triangles = placed(mesh, frame);
  std::size_t count = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = 0; j < triangles.size(); ++j) {
      const Placed &a = triangles[i], &b = triangles[j];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t next = (c + 1) % 3;
        if (std::count(b.face.begin(), b.face.end(), a.face[c]) > 0) continue;
        if (std::count(b.face.begin(), b.face.end(), a.face[next]) > 0) continue;
        count += pierces(a.points[c], a.points[next], b) ? 1 : 0;
      }
    }
  }
  return count;
}

/// Degrees between normals at an edge from which on a face lies folded on another.
constexpr double kFold = 150;

class SimplifiedInEveryFrame : public testing::TestWithParam<const char*> {};

TEST_P(SimplifiedInEveryFrame, NothingFoldsOrPassesThroughItself) {
  const corpus::CorpusSequence original = corpus::find_corpus_entry(GetParam())->make({400, 6});
  const Sequence& sequence = original.sequence;
  for (const SimplifyPriority priority : {SimplifyPriority::kMaps, SimplifyPriority::kMeasure}) {
    SimplifyOptions options = down_to({sequence.mesh.vertex_count * 2 / 5, sequence.mesh.vertex_count / 6});
    options.priority = priority;
    const auto result = test::simplify(sequence, options);
    ASSERT_TRUE(result) << result.error().describe();
    for (const SimplifiedMesh& simple : result->meshes) {
      const std::vector<FramePositions> frames = test::frames_of(simple, sequence.frames);
      for (std::size_t f = 0; f < frames.size(); ++f) {
        const auto before = surface_faults(sequence.mesh, sequence.frames[f], kFold);
        const auto after = surface_faults(simple.mesh, frames[f], kFold);
        ASSERT_TRUE(before && after);
        EXPECT_LE(after->intersections, before->intersections) << "frame " << f;
        EXPECT_LE(after->folds, before->folds) << "frame " << f;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Corpus, SimplifiedInEveryFrame, testing::Values("face", "hand", "cloth"),
                         [](const auto& parameter) { return std::string(parameter.param); });

/// A grid of three rows, the outer ones bent down along the middle one by so many degrees each.
FramePositions bent(double degrees) {
  FramePositions frame;
  const double angle = degrees * std::numbers::pi / 180;
  for (int row = -1; row <= 1; ++row) {
    for (int column = 0; column < 3; ++column) {
      for (const double x : {double(column), row * std::cos(angle), -std::abs(row) * std::sin(angle)}) {
        frame.push_back(static_cast<float>(x));
      }
    }
  }
  return frame;
}

TEST(SimplifySafeguards, ABendInALaterFrameForbidsWhatTheFirstAllows) {
  Sequence grid = test::flat_grid(3, 3);
  grid.frames = {bent(0)};
  SimplifyOptions options = down_to({3});
  options.largest_turn = 30;
  const auto flat = test::simplify(grid, options);
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->meshes[0].vertices, (std::vector<std::uint32_t>{0, 2, 6, 8})) << "only corners turn";

  grid.frames = {bent(0), bent(50), bent(0)};
  const auto moving = test::simplify(grid, options);
  ASSERT_TRUE(moving);
  EXPECT_EQ(moving->meshes[0].vertices, (std::vector<std::uint32_t>{0, 2, 3, 5, 6, 8}))
      << "the ends of the crease stay";
}

TEST(SimplifySafeguards, WhatStandsInATentInALaterFrameIsNotPassedThrough) {
  // A sheet whose middle rises in the second frame, and a triangle that then stands upright within the tent:
  // a flat sheet would cut it.
  Sequence both = test::flat_grid(3, 3);
  both.frames.push_back(both.frames[0]);
  both.frames[1][3 * 4 + 2] = 1.5f;
  both.mesh.vertex_count = 12;
  both.mesh.faces.push_back({9, 10, 11});
  for (const float x : {1.0f, 1.0f, -9.0f, 1.1f, 1.0f, -9.0f, 1.0f, 1.0f, -8.0f}) both.frames[0].push_back(x);
  for (const float x : {0.8f, 1.05f, -0.5f, 1.2f, 1.05f, -0.5f, 1.0f, 1.05f, 0.5f})
    both.frames[1].push_back(x);
  ASSERT_EQ(crossings(both.mesh, both.frames[1]), 0u);
  for (const std::uint32_t checked : {0u, 2u}) {
    SimplifyOptions options = down_to({11});
    options.intersection_frames = checked;
    options.priority = SimplifyPriority::kMeasure;
    options.importance.criteria = {{"weights", 1.0}};
    options.importance.weights.assign(12, 1.0);
    options.importance.weights[4] = 0;
    const auto result = test::simplify(both, options);
    ASSERT_TRUE(result) << result.error().describe();
    const SimplifiedMesh& simple = result->meshes[0];
    ASSERT_EQ(simple.vertices.size(), 11u);
    const std::size_t count = crossings(simple.mesh, test::frames_of(simple, both.frames)[1]);
    const bool keeps_middle = std::count(simple.vertices.begin(), simple.vertices.end(), 4u) > 0;
    EXPECT_EQ(keeps_middle, checked != 0);
    EXPECT_EQ(count == 0, checked != 0) << count;
  }
}

}  // namespace
}  // namespace tvg
