#include "decoder/exporters/frame_sink.hpp"
#include "tests/exporters/whole_mesh.hpp"
#include "tests/importers/io_toolbox.hpp"

#include <bit>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

// What meshes have beside their connectivity, in the files that are written.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class PropertiesTest : public ::testing::Test {
 protected:
  /// The notes of a sink that has written `frames` frames to `name`.
  std::vector<std::string> write(const std::string& name, int frames = 1,
                                 const std::vector<NamedData>& data = {}) {
    const auto sink = open_sink(folder_.path(name), {});
    for (const NamedData& each : data) sink->add_data(each);
    whole_.write(*sink, frames);
    return sink->notes();
  }

  TemporaryFolder folder_;
  WholeMesh whole_;
};

TEST_F(PropertiesTest, ObjHasTexcoordsNormalsColoursPartsAndPolygons) {
  whole_.add_normals();
  whole_.add_colours();
  EXPECT_THAT(write("a.obj"), IsEmpty());
  EXPECT_EQ(folder_.read("a.obj"),
            "# TVG\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nv 2 0 0 0 0 0\n"
            "v 2 1 0 1 0.2 0\n"
            "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 0.75 0\nvt 1 0\nvt 1 1\nvt 0.75 1\n"
            "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 1 0\n"
            "o left\ng front\nusemtl red\nf 1/1/1 2/2/2 3/3/3 4/4/4\n"
            "o right\ng\nusemtl blue\nf 2/5/2 5/6/5 6/7/6 3/8/3\n");
}

TEST_F(PropertiesTest, ObjWithNormalsAloneHasNoTexcoords) {
  whole_.properties.attributes.clear();
  whole_.properties.parts.clear();
  whole_.properties.face_parts.clear();
  whole_.add_normals();
  write("a.obj");
  EXPECT_THAT(folder_.read("a.obj"), HasSubstr("\nf 1//1 2//2 3//3 4//4\n"));
  EXPECT_THAT(folder_.read("a.obj"), StartsWith("# TVG\no squares\nv "));
}

TEST_F(PropertiesTest, TrianglesThatAreNoFanStayTriangles) {
  whole_.mesh.faces[1] = {2, 3, 0};
  whole_.properties.attributes.clear();
  write("a.obj");
  EXPECT_THAT(folder_.read("a.obj"), HasSubstr("usemtl red\nf 1 2 3\nf 3 4 1\no right"));
}

TEST_F(PropertiesTest, MaterialsLieBesideAWholeSequenceOfObj) {
  EXPECT_THAT(write("walk_%02d.obj", 2, {two_materials(), named_data("image/wood.png", kPng)}), IsEmpty());
  EXPECT_THAT(folder_.names(), ElementsAre("walk.mtl", "walk_00.obj", "walk_01.obj", "wood.png"));
  EXPECT_EQ(folder_.read("walk.mtl"),
            "# TVG\n\nnewmtl red\nKd 1 0 0\nNs 225\nPr 0.5\nPm 0\nd 0.5\nKe 0 0 0.25\nillum 2\n"
            "map_Kd wood.png\n\nnewmtl blue\nKd 0 0 1\nKa 0.1 0.1 0.1\nmap_Kd wood.png\n");
  EXPECT_EQ(folder_.read("wood.png"), kPng);
  for (const std::string name : {"walk_00.obj", "walk_01.obj"})
    EXPECT_THAT(folder_.read(name), StartsWith("# TVG\nmtllib walk.mtl\nv "));
}

TEST_F(PropertiesTest, ImagesGetNamesThatStayInTheFolder) {
  const NamedData materials = named_data("materials", R"({"materials": [{"name": "red"}]})");
  folder_.write("out/there", "");
  write("out/a.obj", 1,
        {materials, named_data("image/../../evil.sh", kPng), named_data("image/.profile", kPng),
         named_data("image/x", "no image")});
  EXPECT_THAT(folder_.names(), ElementsAre("out"));
  EXPECT_FALSE(folder_.read("out/evil.png").empty());
  EXPECT_FALSE(folder_.read("out/image.png").empty());
}

TEST_F(PropertiesTest, FilesOfOthersBesideAnOutputStayAsTheyAre) {
  folder_.write("a.mtl", "newmtl mine\n");
  const auto status_of = [&](const std::string& name) {
    try {
      write(name, 1, {two_materials(), named_data("image/wood.png", kPng)});
    } catch (const ToolError& error) {
      return error.status();
    }
    return ExitStatus::kSuccess;
  };
  EXPECT_EQ(status_of("a.obj"), ExitStatus::kUsage);
  EXPECT_EQ(status_of("a.mdd"), ExitStatus::kUsage);
  folder_.write("wood.png", "another picture");
  EXPECT_EQ(status_of("b.obj"), ExitStatus::kUsage);
  EXPECT_THAT(folder_.names(), ElementsAre("a.mtl", "wood.png"));
  folder_.write("wood.png", kPng);
  EXPECT_EQ(status_of("b.obj"), ExitStatus::kSuccess);
  EXPECT_EQ(status_of("b.obj"), ExitStatus::kSuccess);
}

TEST_F(PropertiesTest, MaterialsThatNobodyCanReadAreNamedAndNotWritten) {
  const std::string deep(100000, '[');
  for (const std::string& json : {deep, std::string("{"), std::string("[1]")}) {
    EXPECT_THAT(write("a.obj", 1, {named_data("materials", json)}),
                ElementsAre(HasSubstr("no JSON that can be read")));
    EXPECT_THAT(folder_.names(), ElementsAre("a.obj"));
    EXPECT_THAT(write("a.glb", 1, {named_data("materials", json)}).back(),
                HasSubstr("no JSON that can be read"));
    std::filesystem::remove(folder_.path("a.glb"));
  }
}

TEST_F(PropertiesTest, PlyHasPropertiesOfVerticesAndTexcoordsOfCorners) {
  whole_.add_normals();
  whole_.add_colours();
  whole_.add(AttributeKind::kGeneric, 1, {1, 2, 3, 4, 5, 6}, "heat in K");
  whole_.add(AttributeKind::kGeneric, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "flow");
  EXPECT_THAT(write("a.ply"), ElementsAre(HasSubstr("no place for objects, groups and materials")));
  const std::string ply = folder_.read("a.ply");
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
      "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nproperty float heat_in_K\nproperty float flow_0\n"
      "property float flow_1\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nend_header\n";
  EXPECT_THAT(ply, StartsWith(header));
  EXPECT_EQ(ply.size(), header.size() + 6 * 39 + 2 * (1 + 16 + 1 + 32));
  ByteString last(false);
  last.text("\x08");
  for (const float value : {0.75F, 0.0F, 1.0F, 0.0F, 1.0F, 1.0F, 0.75F, 1.0F}) last.add(value);
  EXPECT_EQ(ply.substr(ply.size() - 33), last.bytes());
}

TEST_F(PropertiesTest, PlyHasTexcoordsOfVerticesWhereNoCornersDiffer) {
  whole_.properties.attributes[0].corners = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
  whole_.add(AttributeKind::kColour, 4, std::vector<float>(24, 0.3333F));
  write("a.ply");
  EXPECT_THAT(folder_.read("a.ply"), HasSubstr("property float s\nproperty float t\nproperty float red\n"
                                               "property float green\nproperty float blue\n"
                                               "property float alpha\nelement face 2\n"
                                               "property list uchar int vertex_indices\nend_header\n"));
}

TEST_F(PropertiesTest, OffHasColours) {
  EXPECT_THAT(write("a.off"), ElementsAre(HasSubstr("OFF has no place for texture coordinates and objects")));
  EXPECT_THAT(folder_.read("a.off"), StartsWith("OFF\n6 2 0\n0 0 0\n"));
  whole_.add_colours();
  write("a.off");
  EXPECT_EQ(folder_.read("a.off"),
            "COFF\n6 2 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n1 1 0 0 0 255 255\n0 1 0 255 255 255 255\n"
            "2 0 0 0 0 0 255\n2 1 0 255 51 0 255\n4 0 1 2 3\n4 1 4 5 2\n");
  whole_.properties.attributes.back().values.assign(18, 0.25F);
  write("a.off");
  EXPECT_THAT(folder_.read("a.off"), HasSubstr("\n2 1 0 0.25 0.25 0.25 1.0\n"));
}

TEST_F(PropertiesTest, StlTellsWhatItLoses) {
  EXPECT_THAT(write("a.stl"),
              ElementsAre(HasSubstr("order of vertices"),
                          HasSubstr("texture coordinates, objects, groups and materials and polygons")));
}

TEST_F(PropertiesTest, CachesHaveTheirAttributesInTheMeshBeside) {
  whole_.add(AttributeKind::kGeneric, 1, {1, 2, 3, 4, 5, 6}, "heat");
  for (const std::string name : {"a.pc2", "a.mdd", "a.npy"}) {
    EXPECT_THAT(write(name, 2, {two_materials()}),
                ElementsAre(HasSubstr("attributes and parts are in " + folder_.path("a.obj")),
                            HasSubstr("OBJ has no place for \"heat\"")));
    EXPECT_THAT(folder_.read("a.obj"), StartsWith("# TVG\nmtllib a.mtl\nv 0 0 0\n"));
    EXPECT_THAT(folder_.read("a.obj"), HasSubstr("\nf 2/5 5/6 6/7 3/8\n"));
    EXPECT_THAT(folder_.read("a.mtl"), HasSubstr("newmtl blue"));
  }
}

TEST_F(PropertiesTest, NumpyArraysAreFramesOfVertices) {
  for (const std::optional<std::uint64_t> count : {std::optional<std::uint64_t>(3), {}}) {
    const auto sink = open_sink(folder_.path("a.npy"), {});
    sink->begin_mesh(whole_.mesh, {}, {}, count);
    for (int i = 0; i < 3; ++i) sink->write_frame(whole_.frame(i));
    sink->finish();
    ByteString expected(false);
    expected.text({"\x93NUMPY\x01\x00\x76\x00", 10});
    std::string words = "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 6, 3), }";
    words.resize(117, ' ');
    expected.text(words + "\n");
    for (int i = 0; i < 3; ++i) {
      for (const float value : whole_.frame(i)) expected.add(value);
    }
    EXPECT_EQ(folder_.read("a.npy"), expected.bytes());
  }
}

TEST_F(PropertiesTest, MddHasTheTimesOfTheStreamWheneverTheyCome) {
  ByteString times(false);
  for (const double time : {0.0, 0.04, 0.12}) times.add(time);
  const NamedData data = named_data("times", times.bytes());
  ByteString expected(true);
  expected.add(3).add(6);
  for (const float time : {0.0F, 0.04F, 0.12F}) expected.add(time);
  for (const bool late : {false, true}) {
    for (const std::uint64_t announced : {3U, 1U}) {
      const auto sink = open_sink(folder_.path("a.mdd"), {});
      if (!late) sink->add_data(data);
      sink->begin_mesh(whole_.mesh, {}, {{"fps", "25"}}, announced);
      for (int i = 0; i < 3; ++i) sink->write_frame(whole_.frame(i));
      if (late) sink->add_data(data);
      sink->finish();
      EXPECT_THAT(folder_.read("a.mdd"), StartsWith(expected.bytes())) << late << announced;
      EXPECT_EQ(folder_.read("a.mdd").size(), 20U + 3 * 72);
    }
  }
}

TEST_F(PropertiesTest, AnimatedAttributesAreThoseOfEachFrame) {
  whole_.add_normals();
  whole_.properties.attributes[1].animated = true;
  whole_.properties.attributes[1].values.clear();
  const auto sink = open_sink(folder_.path("a_%d.obj"), {});
  sink->begin_mesh(whole_.mesh, whole_.properties, {}, 2);
  for (const float z : {1.0F, -1.0F}) {
    std::vector<float> normals;
    for (int i = 0; i < 6; ++i) normals.insert(normals.end(), {0, 0, z});
    const std::vector<std::span<const float>> animated = {{}, normals};
    sink->write_frame(whole_.positions, animated);
  }
  sink->finish();
  EXPECT_THAT(folder_.read("a_0.obj"), HasSubstr("\nvn 0 0 1\n"));
  EXPECT_THAT(folder_.read("a_0.obj"), Not(HasSubstr("\nvn 0 0 -1\n")));
  EXPECT_THAT(folder_.read("a_1.obj"), HasSubstr("\nvn 0 0 -1\n"));
}

}  // namespace
}  // namespace tvg::cli
