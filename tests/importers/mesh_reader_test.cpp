#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "tests/importers/sample_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Parser = void (*)(const std::string&, std::string_view, MeshFile&);

MeshFile parsed(Parser parser, const std::string& bytes) {
  MeshFile mesh;
  parser("file", bytes, mesh);
  return mesh;
}

std::string message_of(Parser parser, const std::string& bytes) {
  return thrown_by([&] { parsed(parser, bytes); }).what();
}

TEST(ObjReader, ReadsEveryFormOfCornerAndTheName) {
  const MeshFile mesh = parsed(parse_obj, sample_obj());
  EXPECT_EQ(mesh.positions, tetrahedron_positions(0));
  EXPECT_EQ(mesh.faces, kTetrahedron);
  EXPECT_EQ(mesh.name, "thing");
}

TEST(ObjReader, ReadsCrLfContinuationsExtraColumnsAndLateVertices) {
  const MeshFile mesh =
      parsed(parse_obj,
             "g first\r\nf 1 \\\r\n 2 3\r\n\tv +1.5 2e-1 -3 1.0 0.5 \\\n 0.5\r\nv 0 \\\n0 0\n\n"
             "v 1e-50 1 -0 # comment\nusemtl f\nf 1 2 3 # comment\n");
  EXPECT_THAT(mesh.positions, ElementsAre(1.5F, 0.2F, -3, 0, 0, 0, 0, 1, 0));
  EXPECT_TRUE(std::signbit(mesh.positions[8]));
  EXPECT_THAT(mesh.faces, ElementsAre(Face{0, 1, 2}, Face{0, 1, 2}));
  EXPECT_EQ(mesh.name, "first");
}

TEST(ObjReader, TriangulatesPolygonsAsFansAndCountsThem) {
  const MeshFile mesh =
      parsed(parse_obj, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 0\nf 1 2 3 4 5\nf 1 2 3\nf 4 3 2 1\n");
  EXPECT_THAT(mesh.faces, ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}, Face{0, 3, 4}, Face{0, 1, 2},
                                      Face{3, 2, 1}, Face{3, 1, 0}));
  EXPECT_THAT(mesh.polygons, ElementsAre(Polygon{0, 5}, Polygon{4, 4}));
}

TEST(ObjReader, RefusesBrokenContentWithItsLine) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const auto message = [&](const std::string& rest) { return message_of(parse_obj, vertices + rest); };
  EXPECT_THAT(message("f 1 2 4\n"),
              HasSubstr("file, line 4: the face uses vertex 4, but the file has 3 vertices"));
  EXPECT_THAT(message("f 1 2 0\n"), HasSubstr("line 4: the face uses vertex 0"));
  EXPECT_THAT(message("f 1 2 -4\n"), HasSubstr("line 4: the face uses vertex -4"));
  EXPECT_THAT(message("f 1 2 99999999999\n"), HasSubstr("line 4: the face uses vertex 99999999999"));
  EXPECT_THAT(message("f 1 2 99999999999999999999\n"), HasSubstr("line 4: '99999999999999999999'"));
  EXPECT_THAT(message("f 1 2"), HasSubstr("inside line 4, which has no line end: the file is cut"));
  EXPECT_THAT(message("f 1 2 3x\n"), HasSubstr("line 4: a corner"));
  EXPECT_THAT(message("v 1 2\n"), HasSubstr("line 4: a number is missing"));
  EXPECT_THAT(message("v 1 2 3.5.6\n"), HasSubstr("line 4: '3.5.6' stands where a number should be"));
  EXPECT_THAT(message("v 1 2 1e40\n"),
              HasSubstr("line 4: '1e40' stands where a number that float32 can hold"));
  EXPECT_THAT(message("v 1 nan 1\nf 1 2 4\n"),
              HasSubstr("line 4: vertex 3 has a coordinate that is NaN or infinite"));
  EXPECT_THAT(message("v 1 -inf 1\nf 1 2 4\n"),
              HasSubstr("line 4: vertex 3 has a coordinate that is NaN or infinite"));
  EXPECT_THAT(message(""), HasSubstr("file has no faces"));
  EXPECT_THAT(message("f 1 2 3x"), HasSubstr("line 4, which has no line end: the file is cut"));
  EXPECT_THAT(message(std::string("f 1 2 3\0\n", 9)), HasSubstr("byte 31 is zero"));
}

TEST(OffReader, ReadsPlainColouredAndNormalVariants) {
  const std::string rows = "0 0 0 1 0 0 255\n1 0 0\t1 0 0\r\n\n0 1 0.125\n0 -0.5 1 # tip\n";
  const std::string faces = "3 0 2 1\n3 0 1 3 255 0 0\n3 0 3 2 0.5\n3 1 2 3\n\n# end\n";
  for (const char* header :
       {"OFF\n4 4 6\n", "COFF 4 4 6\n", "NOFF\r\n4 4\r\n", "# first\nSTCNOFF\n\n4 4 0\n"}) {
    const MeshFile mesh = parsed(parse_off, header + rows + faces);
    EXPECT_EQ(mesh.positions, tetrahedron_positions(0)) << header;
    EXPECT_EQ(mesh.faces, kTetrahedron) << header;
  }
  EXPECT_EQ(parsed(parse_off, sample_off()).faces, kTetrahedron);
}

TEST(OffReader, RefusesBrokenContentWithItsLine) {
  const auto message = [](const std::string& text) { return message_of(parse_off, text); };
  EXPECT_THAT(message("PNG\n"), HasSubstr("line 1: an OFF file begins with"));
  EXPECT_THAT(message("4OFF\n1 1 1\n"), HasSubstr("line 1: '4OFF' is a variant that is not read"));
  EXPECT_THAT(message("OFF BINARY\n"), HasSubstr("binary OFF files are not read"));
  EXPECT_THAT(message("OFF\n-1 4 0\n"), HasSubstr("line 2: the number of vertices is -1"));
  EXPECT_THAT(message("OFF\n99999999999 4 0\n"), HasSubstr("line 2: the number of vertices is 99999999999"));
  EXPECT_THAT(message("OFF\n3 0 0\n"), HasSubstr("has no faces"));
  EXPECT_THAT(message("OFF\n4000000000 1 0\n0 0 0\n"),
              HasSubstr("ends at line 4 inside vertex 1; its header promises 4000000000"));
  EXPECT_THAT(message("OFF\n1 2 0\n0 0 0\n3 0 0 0\n"),
              HasSubstr("ends at line 5 inside face 1; its header promises 2"));
  EXPECT_THAT(message("OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), HasSubstr("line 4: the face uses vertex 1"));
  EXPECT_THAT(message("OFF\n1 1 0\n0 0 0\n-2 0 0\n"), HasSubstr("line 4: a face has -2 corners"));
  EXPECT_THAT(message(std::string("OFF BINARY\n\0\0\0\4", 15)), HasSubstr("binary OFF files are not read"));
  EXPECT_THAT(message("OFF\n1 1 0\n0 0 0\n3 0 0\n"), HasSubstr("line 4: a whole number is missing"));
  EXPECT_THAT(parsed(parse_off, "OFF\n1 1 0\n0 0 0\n3 0 0 0\n# end\nmore\n").notes,
              ElementsAre("5 bytes behind what its header promises left out"));
}

TEST(PlyReader, ReadsAsciiAndBothBinaryOrdersWithForeignProperties) {
  EXPECT_EQ(parsed(parse_ply, sample_ply_ascii()).positions, tetrahedron_positions(0));
  EXPECT_EQ(parsed(parse_ply, sample_ply_ascii()).faces, kTetrahedron);
  for (const bool big_endian : {false, true}) {
    const MeshFile mesh = parsed(parse_ply, sample_ply_binary(big_endian));
    EXPECT_THAT(mesh.positions, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0.125F, 0, -5, 1));
    EXPECT_EQ(mesh.faces, kTetrahedron);
  }
}

TEST(PlyReader, ReadsAsciiWithListsCrLfAndPolygons) {
  const MeshFile mesh =
      parsed(parse_ply,
             "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty list uchar int tags\r\n"
             "property double y\r\nproperty float x\r\nproperty float z\r\nelement face 1\r\n"
             "property list uchar uint vertex_index\r\nproperty uchar red\r\nend_header\r\n"
             "2 7 8 0 0 0\r\n0 0 1 0\r\n0 1 1 0\r\n\r\n1 5 1 0 0\r\n4 0 1 2 3 255\r\n");
  EXPECT_THAT(mesh.positions, ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0));
  EXPECT_THAT(mesh.faces, ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}));
  EXPECT_THAT(mesh.polygons, ElementsAre(Polygon{0, 4}));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, text.npos) << from;
  return text.replace(place, from.size(), to);
}

TEST(PlyReader, RefusesBrokenContentWithItsPlace) {
  const auto message = [](const std::string& from, const std::string& to) {
    return message_of(parse_ply, replaced(sample_ply_ascii(), from, to));
  };
  EXPECT_THAT(message("ply", "plx"), HasSubstr("line 1: a PLY file begins with"));
  EXPECT_THAT(message("ascii 1.0", "ascii 2.0"), HasSubstr("line 2: the version is '2.0'"));
  EXPECT_THAT(message("vertex 4", "vertex -4"),
              HasSubstr("line 4: '-4' stands where the number of elements"));
  EXPECT_THAT(message("vertex 4", "vertex 99999999999999999999"),
              HasSubstr("line 4: '99999999999999999999'"));
  EXPECT_THAT(message("vertex 4", "vertex 99999999999"),
              HasSubstr("line 4: 32-bit indices cannot name 99999999999"));
  EXPECT_THAT(message("vertex 4", "vertex 5"), HasSubstr("line 15: more values than the header promises"));
  EXPECT_THAT(message("face 4", "face 5"), HasSubstr("ends at line 19 inside face 4; its header promises 5"));
  EXPECT_THAT(message("face 4", "face 0"), HasSubstr("has no faces"));
  EXPECT_THAT(message("float z", "float w"), HasSubstr("no property 'z'"));
  EXPECT_THAT(message("float z", "float y"), HasSubstr("line 7: a second property 'y'"));
  EXPECT_THAT(message("element face", "element vertex"), HasSubstr("line 8: a second element 'vertex'"));
  EXPECT_THAT(message("vertex_indices", "corners"), HasSubstr("no list 'vertex_indices'"));
  EXPECT_THAT(message("uchar int", "uchar half"), HasSubstr("line 9: 'half' is not a PLY type"));
  EXPECT_THAT(message("uchar int", "float int"), HasSubstr("line 9: the length of a list"));
  EXPECT_THAT(message("3 0 2 1", "3 0 2 4"), HasSubstr("line 15: the face uses vertex 4"));
  EXPECT_THAT(message("3 0 2 1", "3 0 2 -1"), HasSubstr("line 15: the face uses vertex -1"));
  EXPECT_THAT(message("3 0 2 1", "-3 0 2 1"),
              HasSubstr("line 15: the list 'vertex_indices' has the length -3"));
  EXPECT_THAT(message("0 1 0.125", "0 inf 0.125"),
              HasSubstr("line 13: vertex 2 has a coordinate that is NaN"));
  EXPECT_THAT(parsed(parse_ply, sample_ply_ascii() + "\n\nmore").notes,
              Contains(HasSubstr("4 bytes behind")));
  EXPECT_THAT(parsed(parse_ply, sample_ply_binary(true) + "x").notes,
              ElementsAre("the vertex properties bones are left out",
                          "the face properties group, area are left out", HasSubstr("1 bytes behind")));
}

TEST(PlyReader, RefusesBinaryListsThatClaimMoreThanTheFileHas) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list uint double big\n"
      "property float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  ByteString bytes(false);
  bytes.text(header).add(std::uint32_t{0xffffffff}).add(1.0);
  EXPECT_THAT(message_of(parse_ply, bytes.bytes()), HasSubstr("inside vertex 0; its header promises 1"));
}

TEST(StlReader, ReadsAsciiAndBinaryAndWeldsBitIdenticalCorners) {
  for (const std::string& bytes : {sample_stl_ascii(), sample_stl_binary(tetrahedron_positions(0))}) {
    MeshFile mesh = parsed(parse_stl, bytes);
    EXPECT_EQ(mesh.vertex_count(), 12U);
    const Weld weld = weld_positions(mesh.positions);
    EXPECT_EQ(weld.vertex_count(), 4U);
    EXPECT_THAT(weld.vertex_of_point, ElementsAre(0, 1, 2, 0, 2, 3, 0, 3, 1, 2, 1, 3));
    apply_weld(weld, mesh);
    EXPECT_THAT(mesh.positions, ElementsAre(0, 0, 0, 0, 1, 0.125F, 1, 0, 0, 0, -0.5F, 1));
    EXPECT_THAT(mesh.faces, ElementsAre(Face{0, 1, 2}, Face{0, 2, 3}, Face{0, 3, 1}, Face{2, 1, 3}));
  }
}

TEST(StlReader, RefusesBrokenContentWithItsPlace) {
  const auto message = [](const std::string& from, const std::string& to) {
    return message_of(parse_stl, replaced(sample_stl_ascii(), from, to));
  };
  EXPECT_THAT(message("outer loop", "inner loop"),
              HasSubstr("line 3: 'inner' stands where 'outer' should be"));
  EXPECT_THAT(message("vertex 0.0", "vertex x.0"),
              HasSubstr("line 4: 'x.000000' stands where a number should be"));
  EXPECT_THAT(message("vertex 0.000000", "vertex inf"),
              HasSubstr("line 4: triangle 0 has a coordinate that is NaN"));
  EXPECT_THAT(message("    endloop", "vertex 1 2 3"), HasSubstr("line 7: 'vertex' stands where 'endloop'"));
  EXPECT_THAT(message_of(parse_stl, "solid a\nendsolid a\n"), HasSubstr("has no triangles"));
  std::string binary = sample_stl_binary(tetrahedron_positions(0));
  EXPECT_THAT(parsed(parse_stl, binary + "x").notes, ElementsAre("1 bytes behind its 4 triangles left out"));
  binary[84 + 50 + 12 + 3] = '\x7f';
  binary[84 + 50 + 12 + 2] = '\xc0';
  EXPECT_THAT(message_of(parse_stl, binary), HasSubstr("triangle 1 has a coordinate that is NaN"));
}

}  // namespace
}  // namespace tvg::cli
