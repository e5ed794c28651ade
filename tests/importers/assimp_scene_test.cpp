#include "encoder/importers/collada_keys.hpp"
#include "encoder/importers/scene_summary.hpp"
#include "tests/importers/scene_fixture.hpp"

#include <gmock/gmock.h>

// What assimp loses of a scene.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

using AssimpScene = Scenes;

/// Two triangles that move up by three within a second.
std::string collada(const std::string& interpolations) {
  const auto source = [](const std::string& id, const std::string& array, std::size_t count,
                         std::size_t stride, const std::string& parameters) {
    return "<source id=\"" + id + "\">" + array + "<technique_common><accessor source=\"#" + id +
           "a\" count=\"" + std::to_string(count) + "\" stride=\"" + std::to_string(stride) + "\">" +
           parameters + "</accessor></technique_common></source>\n";
  };
  const std::string xyz =
      R"(<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>)";
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g" name="g"><mesh>)" +
         source("p", R"(<float_array id="pa" count="12">0 0 0 1 0 0 1 2 0 0 2 1</float_array>)", 4, 3, xyz) +
         R"(<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="2">
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry></library_geometries>
<library_animations><animation id="a">)" +
         source("t", R"(<float_array id="ta" count="3">0 0.5 1</float_array>)", 3, 1,
                R"(<param name="TIME" type="float"/>)") +
         source("o", R"(<float_array id="oa" count="9">0 0 0 0 1 0 0 3 0</float_array>)", 3, 3, xyz) +
         source("i", "<Name_array id=\"ia\" count=\"3\">" + interpolations + "</Name_array>", 3, 1,
                R"(<param name="INTERPOLATION" type="name"/>)") +
         R"(<sampler id="s"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#o"/>
<input semantic="INTERPOLATION" source="#i"/></sampler><channel source="#s" target="n/m"/></animation></library_animations>
<library_visual_scenes><visual_scene id="vs"><node id="n" name="n"><translate sid="m">0 0 0</translate>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>)";
}

TEST_F(AssimpScene, OfColladaStepsWhereAllKeysStep) {
  const OpenedSource opened = open_file(folder_.write("a.dae", collada("STEP STEP STEP")), {"", {}, "4"});
  EXPECT_THAT(opened.notes, Not(Contains(HasSubstr("keys"))));
  const std::vector<FramePositions> read = read_all(*opened.source).frames;
  ASSERT_EQ(read.size(), 5U);
  for (const auto& [frame, y] : {std::pair(0U, 0.0F), {1U, 0.0F}, {2U, 1.0F}, {3U, 1.0F}, {4U, 3.0F}}) {
    expect_vertex(read[frame], 0, 0, y, 0);
  }
}

TEST_F(AssimpScene, OfColladaSaysWhatIsReadAsLines) {
  const auto notes = [this](const std::string& interpolations) {
    return open_file(folder_.write("a.dae", collada(interpolations))).notes;
  };
  EXPECT_THAT(notes("STEP LINEAR STEP"), Contains(HasSubstr("stepped keys are read as linear ones")));
  EXPECT_THAT(notes("BEZIER\n BEZIER\tLINEAR"), Contains(HasSubstr("curved keys are read as linear ones")));
  EXPECT_THAT(notes("STEP HERMITE LINEAR"),
              Contains(HasSubstr("stepped and curved keys are read as linear")));
  EXPECT_THAT(notes("LINEAR LINEAR LINEAR"), Not(Contains(HasSubstr("keys"))));
}

TEST_F(AssimpScene, OfColladaTakesNoJointsForInterpolations) {
  const ColladaKeys keys = find_collada_keys(
      "<Name_array id=\"j\">STEP Knee</Name_array><Name_array>BEZIER</Name_array>"
      "<Name_array/><Name_array> </Name_array><Name_array");
  EXPECT_FALSE(keys.has_steps);
  EXPECT_TRUE(keys.has_curves);
  EXPECT_THAT(keys.counts, ElementsAre(1U));
}

std::string direct_x(const std::string& rate) {
  return "xof 0303txt 0032\n" + rate +
         "Frame n {\n FrameTransformMatrix { "
         "1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;; }\n"
         " Mesh m {\n  3;\n  0.0;0.0;0.0;,\n  1.0;0.0;0.0;,\n  1.0;1.0;0.0;;\n  1;\n  3;0,1,2;;\n }\n}\n"
         "AnimationSet s {\n Animation a {\n  { n }\n  AnimationKey {\n   2;\n   2;\n   0;3;0.0,0.0,0.0;;,\n"
         "   4800;3;2.0,0.0,0.0;;;\n  }\n }\n}\n";
}

TEST_F(AssimpScene, OfDirectXHas4800TicksASecondWhereItSaysNone) {
  const OpenedSource opened = open_file(folder_.write("a.x", direct_x("")), {"", {}, "30"});
  EXPECT_EQ(opened.source->frame_count(), 31U);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("ticks of its clips a second has: 4800 are taken")));
  EXPECT_THAT(summarize_scene(folder_.path("a.x"), 30).notes, Contains(HasSubstr("4800 are taken")));
  const OpenedSource told = open_file(folder_.write("b.x", direct_x("AnimTicksPerSecond {\n 2400;\n}\n")));
  EXPECT_EQ(told.source->frame_count(), 61U);
  EXPECT_THAT(told.notes, Not(Contains(HasSubstr("ticks"))));
}

TEST_F(AssimpScene, ReadsGltf1WhichIsAssimps) {
  // Version 1 has objects where version 2 has lists.
  const std::string path = folder_.write(
      "old.gltf", R"({"asset":{"version":"1.0"},"scene":"s","scenes":{"s":{"nodes":[]}},"nodes":{}})");
  EXPECT_THAT(thrown_by([&] { open_file(path); }).what(), Not(HasSubstr("it is glTF")));
}

}  // namespace
}  // namespace tvg::cli
