#include "corpus/corpus.hpp"
#include "simplify_toolbox.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace tvg {
namespace {

using test::down_to;
using test::Shape;
using test::shape_of;

TEST(SimplifiedShape, AFlatGridLosesNothingButVertices) {
  const Sequence grid = test::flat_grid(12, 12);
  const auto result = test::simplify(grid, down_to({40, 4}));
  ASSERT_TRUE(result) << result.error().describe();
  ASSERT_EQ(result->meshes.size(), 2u);
  EXPECT_EQ(result->meshes[0].mesh.vertex_count, 40u);
  EXPECT_EQ(result->meshes[1].mesh.vertex_count, 4u);
  EXPECT_EQ(result->meshes[1].vertices, (std::vector<std::uint32_t>{0, 11, 132, 143})) << "the corners stay";
  for (const SimplifyLevel& level : result->levels) EXPECT_LT(level.quadric_error[0], 1e-20);
  for (const SimplifiedMesh& simple : result->meshes) {
    std::vector<float> back(grid.frames[0].size());
    positions_of(simple.mesh, simple.places, test::frames_of(simple, grid.frames)[0], back);
    for (std::size_t i = 2; i < back.size(); i += 3) EXPECT_EQ(back[i], 0);
  }
}

TEST(SimplifiedShape, ASphereStaysClosed) {
  const auto result = test::simplify(test::sphere(3), down_to({100, 20}));
  ASSERT_TRUE(result);
  for (const SimplifiedMesh& simple : result->meshes) {
    const Shape shape = shape_of(simple.mesh);
    EXPECT_TRUE(shape.manifold);
    EXPECT_EQ(shape.euler, 2);
    EXPECT_EQ(shape.boundary_edges, 0u);
  }
  EXPECT_EQ(result->meshes[1].mesh.vertex_count, 20u);
  EXPECT_EQ(result->meshes[1].mesh.faces.size(), 36u);
}

TEST(SimplifiedShape, ATetrahedronIsTheEndOfAClosedMesh) {
  SimplifyOptions options = down_to({3});
  options.largest_turn = 180;
  options.intersection_frames = 0;
  const auto result = test::simplify(test::sphere(2), options);
  ASSERT_TRUE(result);
  EXPECT_GE(result->meshes[0].mesh.vertex_count, 4u);
  EXPECT_EQ(shape_of(result->meshes[0].mesh).euler, 2);
}

TEST(SimplifiedShape, ATorusKeepsItsHole) {
  const auto result = test::simplify(test::torus(16, 32), down_to({60}));
  ASSERT_TRUE(result);
  const Shape shape = shape_of(result->meshes[0].mesh);
  EXPECT_EQ(result->meshes[0].mesh.vertex_count, 60u);
  EXPECT_TRUE(shape.manifold);
  EXPECT_EQ(shape.euler, 0);
  EXPECT_EQ(shape.boundary_edges, 0u);
}

TEST(SimplifiedShape, AnOpenCylinderKeepsItsLoops) {
  const auto result = test::simplify(test::open_cylinder(12, 24), down_to({40}));
  ASSERT_TRUE(result);
  const Shape shape = shape_of(result->meshes[0].mesh);
  EXPECT_EQ(result->meshes[0].mesh.vertex_count, 40u);
  EXPECT_TRUE(shape.manifold);
  EXPECT_EQ(shape.euler, 0);
  EXPECT_EQ(shape.boundary_loops, 2u);
  EXPECT_LT(shape.boundary_edges, 48u) << "loops lose vertices too";
}

TEST(SimplifiedShape, EveryComponentIsKept) {
  const Sequence toy = corpus::make_toy({1500, 2});
  const auto result = test::simplify(toy, down_to({4}));
  ASSERT_TRUE(result);
  const Shape before = shape_of(toy.mesh), after = shape_of(result->meshes[0].mesh);
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(after.euler, before.euler);
  EXPECT_EQ(after.boundary_edges, 0u);
  EXPECT_LT(result->meshes[0].mesh.vertex_count, toy.mesh.vertex_count / 2);
}

TEST(SimplifiedShape, FacesOfANonManifoldEdgeStayTogether) {
  // Three flat grids that share their first column.
  Sequence book{{}, {{}}, {}};
  const std::uint32_t n = 6;
  std::map<std::array<float, 3>, std::uint32_t> known;
  for (int page = 0; page < 3; ++page) {
    const Sequence grid = test::flat_grid(n, n);
    const double angle = 2.0 * page;
    std::vector<std::uint32_t> number;
    for (std::uint32_t v = 0; v < grid.mesh.vertex_count; ++v) {
      const float x = grid.frames[0][3 * v], y = grid.frames[0][3 * v + 1];
      const std::array<float, 3> at = {static_cast<float>(x * std::cos(angle)), y,
                                       static_cast<float>(x * std::sin(angle))};
      const auto [place, fresh] = known.try_emplace(at, book.mesh.vertex_count);
      if (fresh) book.frames[0].insert(book.frames[0].end(), at.begin(), at.end());
      if (fresh) ++book.mesh.vertex_count;
      number.push_back(place->second);
    }
    for (const auto& [a, b, c] : grid.mesh.faces)
      book.mesh.faces.push_back({number[a], number[b], number[c]});
  }
  ASSERT_EQ(book.mesh.vertex_count, 3 * n * n - 2 * n);
  const auto result = test::simplify(book, down_to({3}));
  ASSERT_TRUE(result);
  const SimplifiedMesh& simple = result->meshes[0];
  EXPECT_EQ(simple.mesh.vertex_count, n + 6) << "the spine, and two corners of each page";
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces_at;
  for (const Face& face : simple.mesh.faces) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = face[c], b = face[(c + 1) % 3];
      ++faces_at[{std::min(a, b), std::max(a, b)}];
    }
  }
  EXPECT_EQ(std::count_if(faces_at.begin(), faces_at.end(), [](const auto& e) { return e.second == 3; }),
            n - 1);
}

TEST(SimplifiedShape, ASoupOfEverythingWrongIsSimplified) {
  const corpus::SoupSequence soup = corpus::make_soup({600, 3});
  const auto result = test::simplify(soup.sequence, down_to({200}));
  ASSERT_TRUE(result) << result.error().describe();
  const SimplifiedMesh& simple = result->meshes[0];
  EXPECT_LT(simple.mesh.vertex_count, 300u);
  ASSERT_EQ(simple.places.size(), soup.sequence.mesh.vertex_count);
  for (const Face& face : simple.mesh.faces) {
    EXPECT_TRUE(face[0] != face[1] && face[1] != face[2] && face[2] != face[0]);
  }
  EXPECT_EQ(result->levels[0].removed, soup.defects.isolated_vertices) << "vertices without faces go first";
}

TEST(SimplifiedShape, FacesWithoutAreaAreSimplifiedAway) {
  // Two columns of a grid fall into one, so that the faces between them have no area.
  Sequence grid = test::flat_grid(8, 8);
  for (std::size_t r = 0; r < 8; ++r) grid.frames[0][3 * (8 * r + 4)] = grid.frames[0][3 * (8 * r + 3)];
  grid.mesh.faces.push_back({5, 5, 6});
  const auto result = test::simplify(grid, down_to({12}));
  ASSERT_TRUE(result);
  EXPECT_LE(result->meshes[0].mesh.vertex_count, 20u);
  for (const SurfacePlace& place : result->meshes[0].places) {
    for (const double weight : place.weights) EXPECT_TRUE(std::isfinite(weight));
  }
}

}  // namespace
}  // namespace tvg
