#include "corpus/corpus.hpp"
#include "simplify_toolbox.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace tvg {
namespace {

using test::down_to;

FramePositions positions(const Remesh& remeshed, const Sequence& original, std::size_t frame) {
  FramePositions result(3 * std::size_t{remeshed.mesh.vertex_count});
  positions_of(original.mesh, remeshed.places, original.frames[frame], result);
  return result;
}

TEST(Remesh, WithoutALevelTheBaseComesBack) {
  const Sequence face = corpus::make_face({500, 2});
  const auto simple = test::simplify(face, down_to({100}));
  ASSERT_TRUE(simple);
  const auto remeshed = remesh(*simple, face.mesh, {}, {0, {}});
  ASSERT_TRUE(remeshed);
  EXPECT_EQ(remeshed->mesh, simple->meshes[0].mesh);
  EXPECT_EQ(positions(*remeshed, face, 1), test::frames_of(simple->meshes[0], face.frames)[1]);
}

TEST(Remesh, UniformOnesHaveFourTimesTheFacesAndTheSameShape) {
  const Sequence torus = test::torus(12, 24);
  const auto simple = test::simplify(torus, down_to({50}));
  ASSERT_TRUE(simple);
  for (const std::uint32_t levels : {1u, 3u}) {
    const auto remeshed = remesh(*simple, torus.mesh, {}, {levels, {}});
    ASSERT_TRUE(remeshed);
    EXPECT_EQ(remeshed->mesh.faces.size(), simple->meshes[0].mesh.faces.size() << 2 * levels);
    EXPECT_EQ(remeshed->places.size(), remeshed->mesh.vertex_count);
    const test::Shape shape = test::shape_of(remeshed->mesh);
    EXPECT_TRUE(shape.manifold);
    EXPECT_EQ(shape.euler, 0);
  }
}

TEST(Remesh, ItsVerticesLieOnTheOriginal) {
  const Sequence sphere = test::sphere(3);
  const auto simple = test::simplify(sphere, down_to({30}));
  ASSERT_TRUE(simple);
  const auto remeshed = remesh(*simple, sphere.mesh, {}, {3, {}});
  ASSERT_TRUE(remeshed);
  for (const SurfacePlace& place : remeshed->places) {
    ASSERT_LT(place.face, sphere.mesh.faces.size());
    for (const double weight : place.weights) EXPECT_GE(weight, 0);
    EXPECT_NEAR(std::accumulate(place.weights.begin(), place.weights.end(), 0.0), 1, 1e-12);
  }
  const FramePositions at = positions(*remeshed, sphere, 0);
  // The faces of this sphere are up to 0.02 inside it; chords of the base would be ten times that.
  for (std::size_t v = 0; v < remeshed->mesh.vertex_count; ++v) {
    EXPECT_GT(std::hypot(at[3 * v], at[3 * v + 1], at[3 * v + 2]), 0.97);
  }
}

TEST(Remesh, CarryingBackUndoesTheParameterization) {
  // What was removed last lies at a known place of the base, and nothing but its own removal is undone there.
  const Sequence grid = test::flat_grid(10, 10);
  const auto simple = test::simplify(grid, down_to({4}));
  ASSERT_TRUE(simple);
  const auto remeshed = remesh(*simple, grid.mesh, {}, {4, {}});
  ASSERT_TRUE(remeshed);
  const FramePositions at = positions(*remeshed, grid, 0);
  double area = 0;
  for (const auto& [a, b, c] : remeshed->mesh.faces) {
    area += ((at[3 * b] - at[3 * a]) * (at[3 * c + 1] - at[3 * a + 1]) -
             (at[3 * b + 1] - at[3 * a + 1]) * (at[3 * c] - at[3 * a])) /
            2.0;
  }
  EXPECT_NEAR(area, 81, 1e-3) << "it covers the whole grid, once";
}

TEST(Remesh, AdaptiveOnesCutOnlyWhereItIsNeeded) {
  // Flat but for a bump in one corner, which rises in the second frame alone.
  Sequence sheet = test::flat_grid(24, 24);
  sheet.frames.push_back(sheet.frames[0]);
  for (std::size_t v = 0; v < sheet.mesh.vertex_count; ++v) {
    const double x = sheet.frames[0][3 * v] - 5, y = sheet.frames[0][3 * v + 1] - 5;
    sheet.frames[1][3 * v + 2] = static_cast<float>(2 * std::exp(-(x * x + y * y) / 6));
  }
  const auto simple = test::simplify(sheet, down_to({40}));
  ASSERT_TRUE(simple);
  const auto uniform = remesh(*simple, sheet.mesh, sheet.frames, {3, {}});
  const auto adaptive = remesh(*simple, sheet.mesh, sheet.frames, {3, 0.05});
  ASSERT_TRUE(uniform && adaptive);
  EXPECT_LT(adaptive->mesh.faces.size(), uniform->mesh.faces.size() / 2);
  EXPECT_GT(adaptive->mesh.faces.size(), simple->meshes[0].mesh.faces.size());
  const test::Shape shape = test::shape_of(adaptive->mesh);
  EXPECT_TRUE(shape.manifold);
  EXPECT_EQ(shape.euler, 1) << "a T-vertex would open a slit";
  EXPECT_EQ(shape.boundary_loops, 1u);
  const auto none = remesh(*simple, sheet.mesh, sheet.frames, {3, 100.0});
  ASSERT_TRUE(none);
  EXPECT_EQ(none->mesh, simple->meshes[0].mesh);
}

TEST(Remesh, OptionsOutOfRangeAreRefused) {
  const Sequence grid = test::flat_grid(5, 5);
  const auto simple = test::simplify(grid, down_to({9}));
  ASSERT_TRUE(simple);
  const auto code = [&](const Simplification& s, const Mesh& mesh, const RemeshOptions& options) {
    const auto result = remesh(s, mesh, {}, options);
    return result ? ErrorCode{} : result.error().code;
  };
  EXPECT_EQ(code({}, grid.mesh, {}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(*simple, test::flat_grid(4, 4).mesh, {}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(*simple, grid.mesh, {kMaxRemeshLevels + 1, {}}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(*simple, grid.mesh, {2, 0.1}), ErrorCode::kInvalidArgument) << "no frames";
}

}  // namespace
}  // namespace tvg
