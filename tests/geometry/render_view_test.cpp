#include "tests/connectivity/mesh_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <span>
#include <vector>

#include <tvg/render_view.hpp>

namespace tvg {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;

constexpr std::uint32_t kNone = RenderView::kNoValue;

/// Two triangles that share the edge from vertex 1 to 2.
const Mesh kSquare = {4, {{0, 1, 2}, {2, 1, 3}}};

Attribute of_corners(std::vector<std::uint32_t> corners, std::vector<float> values,
                     std::uint32_t components) {
  Attribute attribute;
  attribute.domain = AttributeDomain::kCorner;
  attribute.components = components;
  attribute.values = std::move(values);
  attribute.corners = std::move(corners);
  return attribute;
}

Attribute of_vertices(std::vector<float> values) {
  Attribute attribute;
  attribute.values = std::move(values);
  return attribute;
}

/// As the square's texture coordinates are where it is cut in two at vertex 1 only.
MeshProperties cut_square() {
  MeshProperties properties;
  properties.attributes.push_back(of_corners({0, 1, 2, 2, 4, 3}, {0, 0, 1, 0, 0, 1, 1, 1, 5, 6}, 2));
  return properties;
}

RenderView view_of(const Mesh& mesh, const MeshProperties& properties) {
  Result<RenderView> view = RenderView::of(mesh, properties);
  if (!view) {
    ADD_FAILURE() << view.error().message;
    return {};
  }
  return std::move(*view);
}

std::vector<std::uint32_t> list(std::span<const std::uint32_t> numbers) {
  return {numbers.begin(), numbers.end()};
}

TEST(RenderView, OfBarePositionsIsTheMesh) {
  const RenderView view = view_of(kSquare, {});
  EXPECT_THAT(list(view.source_vertices()), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(list(view.indices()), ElementsAre(0, 1, 2, 2, 1, 3));
  EXPECT_THAT(list(view.source_faces()), ElementsAre(0, 1));
  ASSERT_EQ(view.ranges().size(), 1u);
  EXPECT_EQ(view.ranges()[0], (RenderView::Range{0, 6}));
  EXPECT_EQ(view.attribute_count(), 0u);
  EXPECT_THAT(view.value_indices(0), IsEmpty());
}

TEST(RenderView, SplitsAVertexWhereItsCornersDiffer) {
  const RenderView view = view_of(kSquare, cut_square());
  EXPECT_THAT(list(view.source_vertices()), ElementsAre(0, 1, 2, 3, 1));
  EXPECT_THAT(list(view.indices()), ElementsAre(0, 1, 2, 2, 4, 3));
  EXPECT_THAT(list(view.value_indices(0)), ElementsAre(0, 1, 2, 3, 4));
}

TEST(RenderView, SplitsOnceForAttributesWithTheSameSeam) {
  MeshProperties properties = cut_square();
  properties.attributes.push_back(of_corners({0, 2, 0, 0, 1, 0}, {7, 8, 9}, 1));
  const RenderView view = view_of(kSquare, properties);
  EXPECT_THAT(list(view.source_vertices()), ElementsAre(0, 1, 2, 3, 1));
  EXPECT_THAT(list(view.value_indices(1)), ElementsAre(0, 2, 0, 0, 1));
}

TEST(RenderView, KeepsVerticesThatNoFaceUses) {
  const Mesh mesh = {6, {{1, 2, 4}}};
  MeshProperties properties;
  properties.attributes.push_back(of_corners({0, 0, 0}, {3}, 1));
  const RenderView view = view_of(mesh, properties);
  EXPECT_THAT(list(view.indices()), ElementsAre(1, 2, 4));
  EXPECT_THAT(list(view.value_indices(0)), ElementsAre(kNone, 0, 0, kNone, 0, kNone));
  std::vector<float> values(6, 9);
  ASSERT_TRUE(
      view.copy_attribute(0, properties.attributes[0].values, std::as_writable_bytes(std::span(values)), 4)
          .ok());
  EXPECT_THAT(values, ElementsAre(0, 3, 3, 0, 3, 0));
}

TEST(RenderView, SortsFacesByTheirPart) {
  const Mesh mesh = {6, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 5}}};
  MeshProperties properties;
  properties.parts.resize(3);
  properties.face_parts = {2, 0, 2, 0};
  const RenderView view = view_of(mesh, properties);
  EXPECT_THAT(list(view.source_faces()), ElementsAre(1, 3, 0, 2));
  EXPECT_THAT(list(view.indices()), ElementsAre(1, 2, 3, 3, 4, 5, 0, 1, 2, 2, 3, 4));
  EXPECT_THAT(view.ranges(),
              ElementsAre(RenderView::Range{0, 6}, RenderView::Range{6, 0}, RenderView::Range{6, 6}));
  EXPECT_THAT(list(view.source_vertices()), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(RenderView, SplitsBetweenPartsWhereTheyHaveAttributes) {
  MeshProperties properties;
  properties.parts.resize(2);
  properties.face_parts = {1, 0};
  properties.attributes.push_back(of_vertices({10, 20}));
  properties.attributes[0].domain = AttributeDomain::kPart;
  const RenderView view = view_of(kSquare, properties);
  EXPECT_THAT(list(view.source_vertices()), ElementsAre(0, 1, 2, 3, 1, 2));
  EXPECT_THAT(list(view.value_indices(0)), ElementsAre(1, 0, 0, 0, 1, 1));
  EXPECT_THAT(list(view.indices()), ElementsAre(2, 1, 3, 0, 4, 5));
}

TEST(RenderView, CopiesIntoRowsOfAnyStride) {
  MeshProperties properties = cut_square();
  properties.attributes.push_back(of_vertices({1, 2, 3, 4}));
  const RenderView view = view_of(kSquare, properties);
  struct Row {
    float position[3];
    float uv[2];
    float weight;
  };
  std::vector<Row> rows(view.vertex_count());
  const std::span<std::byte> bytes = std::as_writable_bytes(std::span(rows));
  const std::vector<float> positions = {0, 0, 1, 1, 0, 2, 0, 1, 3, 1, 1, 4};
  ASSERT_TRUE(view.copy_vertices(positions, bytes, sizeof(Row)).ok());
  ASSERT_TRUE(view.copy_attribute(0, properties.attributes[0].values, bytes.subspan(12), sizeof(Row)).ok());
  ASSERT_TRUE(view.copy_attribute(1, properties.attributes[1].values, bytes.subspan(20), sizeof(Row)).ok());
  EXPECT_THAT(rows[4].position, ElementsAre(1, 0, 2));
  EXPECT_THAT(rows[4].uv, ElementsAre(5, 6));
  EXPECT_EQ(rows[4].weight, 2);
  EXPECT_THAT(rows[3].uv, ElementsAre(1, 1));
}

TEST(RenderView, RefusesBuffersThatAreTooSmall) {
  const MeshProperties properties = cut_square();
  const RenderView view = view_of(kSquare, properties);
  std::vector<float> rows(15);
  const std::span<std::byte> bytes = std::as_writable_bytes(std::span(rows));
  const std::vector<float> positions(12);
  EXPECT_TRUE(view.copy_vertices(positions, bytes).ok());
  EXPECT_FALSE(view.copy_vertices(positions, bytes.first(59)).ok());
  EXPECT_FALSE(view.copy_vertices(positions, bytes, 11).ok());
  EXPECT_FALSE(view.copy_vertices(std::span(positions).first(11), bytes).ok());
  EXPECT_TRUE(view.copy_attribute(0, properties.attributes[0].values, bytes, 8).ok());
  EXPECT_FALSE(view.copy_attribute(0, std::vector<float>(9), bytes, 8).ok());
  EXPECT_FALSE(view.copy_attribute(0, properties.attributes[0].values, bytes, 4).ok());
  EXPECT_FALSE(view.copy_attribute(1, properties.attributes[0].values, bytes, 8).ok());
}

TEST(RenderView, TakesValuesOfAnimatedAttributesFromTheFrame) {
  MeshProperties properties = cut_square();
  properties.attributes[0].animated = true;
  properties.attributes[0].values.clear();
  const RenderView view = view_of(kSquare, properties);
  const std::vector<float> frame = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::vector<float> values(10);
  const std::span<std::byte> bytes = std::as_writable_bytes(std::span(values));
  ASSERT_TRUE(view.copy_attribute(0, frame, bytes, 8).ok());
  EXPECT_THAT(values, ElementsAreArray(frame));
  EXPECT_FALSE(view.copy_attribute(0, std::span(frame).first(8), bytes, 8).ok());
}

TEST(RenderView, RefusesWhatDoesNotFitTheMesh) {
  const auto refused = [](const Mesh& mesh, const MeshProperties& properties) {
    const Result<RenderView> view = RenderView::of(mesh, properties);
    return !view && view.error().code == ErrorCode::kInvalidInput;
  };
  EXPECT_TRUE(refused({3, {{0, 1, 3}}}, {}));
  MeshProperties properties = cut_square();
  properties.attributes[0].corners[3] = 5;
  EXPECT_TRUE(refused(kSquare, properties));
  properties = cut_square();
  properties.attributes[0].corners.pop_back();
  EXPECT_TRUE(refused(kSquare, properties));
  properties = cut_square();
  properties.attributes[0].components = 0;
  EXPECT_TRUE(refused(kSquare, properties));
  properties = cut_square();
  properties.attributes[0].components = 5;
  EXPECT_TRUE(refused(kSquare, properties));
  properties = {};
  properties.attributes.push_back(of_vertices({1, 2, 3}));
  EXPECT_TRUE(refused(kSquare, properties));
  properties = {};
  properties.parts.resize(1);
  EXPECT_TRUE(refused(kSquare, properties));
  properties.face_parts = {0, 1};
  EXPECT_TRUE(refused(kSquare, properties));
}

TEST(RenderView, HasEveryCornerOfAnyMeshAsItWas) {
  std::mt19937 random(7);
  for (int round = 0; round < 30; ++round) {
    const Mesh mesh = test::with_holes(test::closed_surface(5, 4), 0.2, random);
    MeshProperties properties;
    properties.parts.resize(3);
    for (std::size_t face = 0; face < mesh.faces.size(); ++face)
      properties.face_parts.push_back(static_cast<std::uint32_t>(random() % 3));
    for (const std::uint32_t count : {3u, 40u}) {
      std::vector<std::uint32_t> corners(3 * mesh.faces.size());
      for (std::uint32_t& corner : corners) corner = static_cast<std::uint32_t>(random() % count);
      properties.attributes.push_back(of_corners(std::move(corners), std::vector<float>(count), 1));
    }
    const RenderView view = view_of(mesh, properties);
    ASSERT_EQ(view.indices().size(), 3 * mesh.faces.size());
    std::vector<int> seen(view.vertex_count(), 0);
    for (std::size_t i = 0; i < view.indices().size(); ++i) {
      const std::uint32_t face = view.source_faces()[i / 3], vertex = view.indices()[i];
      ASSERT_EQ(view.source_vertices()[vertex], mesh.faces[face][i % 3]);
      for (std::size_t attribute = 0; attribute < 2; ++attribute) {
        ASSERT_EQ(view.value_indices(attribute)[vertex],
                  properties.attributes[attribute].corners[3 * face + i % 3]);
      }
      seen[vertex] = 1;
    }
    seen.erase(seen.begin(), seen.begin() + mesh.vertex_count);
    EXPECT_THAT(seen, Each(1));
  }
}

}  // namespace
}  // namespace tvg
