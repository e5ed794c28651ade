#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/normal_shading.hpp"
#include "encoder/importers/part_table.hpp"
#include "tests/importers/sample_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// What the readers of mesh files make of what stands beside positions and faces.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using Parser = void (*)(const std::string&, std::string_view, MeshFile&);

MeshFile parsed(Parser parser, const std::string& bytes) {
  MeshFile mesh;
  parser("file", bytes, mesh);
  return mesh;
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjProperties, TextureCoordinatesWithASeamBelongToCorners) {
  const MeshFile mesh = parsed(
      parse_obj, kSquare + "vt 0 0\nvt 1 0\nvt 1 1\nvt 9 9\nvt 0.5 0.5\nf 1/1 2/2 3/3\nf 1/5 3/3 4/2\n");
  ASSERT_THAT(mesh.attributes, SizeIs(1));
  const Attribute& uv = mesh.attributes[0];
  EXPECT_EQ(uv.kind, AttributeKind::kTexcoord);
  EXPECT_EQ(uv.domain, AttributeDomain::kCorner);
  EXPECT_EQ(uv.components, 2U);
  EXPECT_THAT(uv.values, ElementsAre(0, 0, 1, 0, 1, 1, 0.5F, 0.5F)) << "what no face uses is left out";
  EXPECT_THAT(uv.corners, ElementsAre(0, 1, 2, 3, 2, 1));
}

TEST(ObjProperties, OneValueForEachVertexBelongsToVertices) {
  const MeshFile mesh = parsed(
      parse_obj,
      kSquare + "vt 0 0 0\nvt 1 0 0\nvt 1 1 0\nvt 0 1 0\nvt 1 1 0\nf 1/1 2/2 3/3 4/4\nf 1/1 3/5 4/4\n");
  ASSERT_THAT(mesh.attributes, SizeIs(1));
  EXPECT_EQ(mesh.attributes[0].domain, AttributeDomain::kVertex);
  EXPECT_EQ(mesh.attributes[0].components, 2U) << "a third number that is always 0 says nothing";
  EXPECT_THAT(mesh.attributes[0].values, ElementsAre(0, 0, 1, 0, 1, 1, 0, 1));
  EXPECT_THAT(mesh.attributes[0].corners, IsEmpty());
  ASSERT_THAT(mesh.polygons, SizeIs(1));
}

TEST(ObjProperties, CornersOfAFanFollowItsTriangles) {
  const MeshFile mesh = parsed(parse_obj, kSquare + "f 1 2 3\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//2 3//1 4//-1\n");
  ASSERT_THAT(mesh.attributes, SizeIs(1));
  const Attribute& normals = mesh.attributes[0];
  EXPECT_EQ(normals.kind, AttributeKind::kNormal);
  ASSERT_THAT(normals.corners, SizeIs(9));
  EXPECT_THAT(normals.corners, ElementsAre(2, 2, 2, 0, 1, 0, 0, 0, 1));
  EXPECT_THAT(normals.values, ElementsAre(0, 0, 1, 0, 1, 0, 0, 0, 0));
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("3 corners have no normals")));
}

TEST(ObjProperties, AttributesMakeNoFileUnreadable) {
  const MeshFile missing = parsed(parse_obj, kSquare + "vt 0 0\nf 1/1 2/2 3/7\n");
  EXPECT_THAT(missing.attributes, IsEmpty());
  EXPECT_THAT(missing.notes, ElementsAre(HasSubstr("the face in line 6 uses one that is not there")));
  const MeshFile odd = parsed(parse_obj, kSquare + "vt nan x\nvt 1 1\nf 1/1 2/2 3/2\n");
  EXPECT_THAT(odd.attributes[0].values, ElementsAre(0, 0, 1, 1, 1, 1, 0, 0));
  EXPECT_THAT(odd.notes, ElementsAre(HasSubstr("2 of its texture coordinates are no numbers")));
}

TEST(ObjProperties, ColoursStandBehindPositions) {
  const MeshFile mesh = parsed(parse_obj, "v 0 0 0 1 0 0.5\nv 1 0 0\nv 1 1 0 0 1 0\nf 1 2 3\n");
  ASSERT_THAT(mesh.attributes, SizeIs(1));
  EXPECT_EQ(mesh.attributes[0].kind, AttributeKind::kColour);
  EXPECT_THAT(mesh.attributes[0].values, ElementsAre(1, 0, 0.5F, 1, 1, 1, 0, 1, 0));
  EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("1 vertices have no colour")));
}

TEST(ObjProperties, PartsAreObjectsGroupsAndMaterialsInAnyOrder) {
  const MeshFile mesh = parsed(parse_obj, "mtllib a b.mtl\no cube\ng left\nusemtl red\n" + kSquare +
                                              "s 1\nf 1 2 3\nusemtl blue\ns off\nf 1 2 3 4\nusemtl red\ns 1\n"
                                              "f 2 3 4\nf 1 2\nusemtl none\n");
  EXPECT_THAT(mesh.material_files, ElementsAre("a b.mtl"));
  EXPECT_THAT(mesh.parts, ElementsAre(Part{"cube", "left", "red"}, Part{"cube", "left", "blue"}));
  EXPECT_THAT(mesh.face_parts, ElementsAre(0, 1, 1, 0));
  ASSERT_THAT(mesh.attributes, SizeIs(1));
  EXPECT_EQ(mesh.attributes[0].name, kSmoothingGroup);
  EXPECT_EQ(mesh.attributes[0].domain, AttributeDomain::kPart);
  EXPECT_THAT(mesh.attributes[0].values, ElementsAre(1, 0));
}

TEST(ObjProperties, NamesBecomeText) {
  const MeshFile mesh = parsed(parse_obj, kSquare + "usemtl gr\xfcn\nf 1 2 3\n");
  EXPECT_THAT(mesh.parts, ElementsAre(Part{"", "", "gr\xc3\xbcn"}));
  EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("read as Latin-1")));
  EXPECT_THAT(parsed(parse_obj, kSquare + "f 1 2 3\n").parts, IsEmpty());
}

TEST(ObjProperties, PositionsOnlyLeavesAllElseOut) {
  MeshFile mesh;
  mesh.positions_only = true;
  parse_obj("file", "usemtl red\nv 0 0 0 1 1 1\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/9\n", mesh);
  EXPECT_THAT(mesh.attributes, IsEmpty());
  EXPECT_THAT(mesh.parts, IsEmpty());
  EXPECT_THAT(mesh.notes, IsEmpty());
}

std::string ply(const std::string& vertex_properties, const std::string& face_properties,
                const std::string& body) {
  return "ply\nformat ascii 1.0\ncomment TextureFile skin.png\nelement vertex 3\nproperty float x\nproperty "
         "float y\n"
         "property float z\n" +
         vertex_properties + "element face 1\nproperty list uchar int vertex_indices\n" + face_properties +
         "end_header\n" + body;
}

TEST(PlyProperties, UsualNamesHaveTheirMeaningAndOthersAreGeneric) {
  const MeshFile mesh = parsed(
      parse_ply,
      ply("property float s\nproperty float t\nproperty uchar red\nproperty uchar green\nproperty uchar "
          "blue\n"
          "property uchar alpha\nproperty float nx\nproperty float ny\nproperty float nz\nproperty int id\n",
          "property float area\n",
          "0 0 0 0 1 255 0 51 255 0 0 1 16777217\n1 0 0 1 1 0 0 0 0 0 0 1 2\n1 1 0 0 0 0 0 0 0 0 0 1 -3\n3 0 "
          "1 2 0.5\n"));
  ASSERT_THAT(mesh.attributes, SizeIs(4));
  EXPECT_EQ(mesh.attributes[0].kind, AttributeKind::kTexcoord);
  EXPECT_THAT(mesh.attributes[0].values, ElementsAre(0, 1, 1, 1, 0, 0));
  EXPECT_EQ(mesh.attributes[1].kind, AttributeKind::kNormal);
  EXPECT_EQ(mesh.attributes[2].kind, AttributeKind::kColour);
  EXPECT_EQ(mesh.attributes[2].components, 4U);
  EXPECT_THAT(mesh.attributes[2].values, ElementsAre(1, 0, 0.2F, 1, 0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_EQ(mesh.attributes[3].name, "id");
  EXPECT_THAT(mesh.attributes[3].values, ElementsAre(16777216, 2, -3));
  EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("1 values of the property 'id' are rounded"),
                                      HasSubstr("the face properties area are left out")));
  EXPECT_THAT(mesh.parts, ElementsAre(Part{"", "", "skin.png"}));
  EXPECT_THAT(mesh.texture_files, ElementsAre("skin.png"));
}

TEST(PlyProperties, FacesHaveTextureCoordinatesForTheirCorners) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar float texcoord\nproperty list uchar int "
      "vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const MeshFile mesh = parsed(parse_ply, head + "8 0 0 1 0 1 1 0 1 4 0 1 2 3\n6 0.5 0 1 1 0 1 3 0 2 3\n");
  ASSERT_THAT(mesh.attributes, SizeIs(1));
  EXPECT_EQ(mesh.attributes[0].domain, AttributeDomain::kCorner);
  EXPECT_THAT(mesh.attributes[0].values, ElementsAre(0, 0, 1, 0, 1, 1, 0, 1, 0.5F, 0));
  EXPECT_THAT(mesh.attributes[0].corners, ElementsAre(0, 1, 2, 0, 2, 3, 4, 2, 3));
  const MeshFile odd = parsed(parse_ply, head + "3 0 0 1 4 0 1 2 3\n0 3 0 2 3\n");
  EXPECT_THAT(odd.attributes, IsEmpty());
  EXPECT_THAT(odd.notes, ElementsAre(HasSubstr("1 lists 'texcoord' are left out")));
}

TEST(OffProperties, KeywordsSayWhatTheColumnsAre) {
  const MeshFile mesh = parsed(parse_off,
                               "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 51 0.25 0.5\n1 0 0 0 0 1 0 0 0 1 1\n"
                               "1 1 0 0 0 1 0 0 0 0 0\n3 0 1 2 255 0 0\n");
  ASSERT_THAT(mesh.attributes, SizeIs(3));
  EXPECT_THAT(mesh.attributes[0].values, ElementsAre(0, 0, 1, 0, 0, 1, 0, 0, 1));
  EXPECT_THAT(mesh.attributes[1].values, ElementsAre(1, 0, 0.2F, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(mesh.attributes[2].values, ElementsAre(0.25F, 0.5F, 1, 1, 0, 0));
  EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("the colours of 1 faces are left out")));
  const MeshFile odd = parsed(parse_off, "COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1\n1 1 0\n3 0 1 2\n");
  EXPECT_THAT(odd.attributes, IsEmpty());
  EXPECT_THAT(odd.notes, ElementsAre(HasSubstr("are left out")));
}

TEST(NormalShading, IsFoundWhereNormalsFollowFromFaces) {
  const FramePositions positions = tetrahedron_positions(0);
  Attribute flat;
  flat.kind = AttributeKind::kNormal;
  flat.domain = AttributeDomain::kCorner;
  flat.components = 3;
  for (std::uint32_t face = 0; face < kTetrahedron.size(); ++face) {
    const auto at = [&](std::size_t corner, std::size_t axis) {
      return positions[3 * kTetrahedron[face][corner] + axis];
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
      flat.values.push_back((at(1, y) - at(0, y)) * (at(2, z) - at(0, z)) -
                            (at(1, z) - at(0, z)) * (at(2, y) - at(0, y)));
    }
    flat.corners.insert(flat.corners.end(), 3, face);
  }
  EXPECT_EQ(find_shading(kTetrahedron, {}, positions, flat), NormalShading::kFlat);
  Attribute other = flat;
  std::swap(other.values[0], other.values[2]);
  EXPECT_EQ(find_shading(kTetrahedron, {}, positions, other), std::nullopt);
  Attribute smooth;
  smooth.kind = AttributeKind::kNormal;
  smooth.components = 3;
  smooth.values.assign(12, 0);
  for (std::size_t face = 0; face < kTetrahedron.size(); ++face) {
    for (const std::uint32_t vertex : kTetrahedron[face]) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        smooth.values[3 * vertex + axis] += flat.values[3 * face + axis];
    }
  }
  EXPECT_EQ(find_shading(kTetrahedron, {}, positions, smooth), NormalShading::kSmooth);
}

}  // namespace
}  // namespace tvg::cli
