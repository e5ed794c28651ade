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

/// A quad and a triangle beside it, with texture coordinates and a material that has a texture.
std::string textured_collada() {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset>
<library_images><image id="im" name="im"><init_from>bricks.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="su"><surface type="2D"><init_from>im</init_from></surface></newparam>
<newparam sid="sa"><sampler2D><source>su</source></sampler2D></newparam>
<technique sid="t"><phong><diffuse><texture texture="sa" texcoord="UV"/></diffuse>
<emission><color>0 0.5 0 1</color></emission></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="Bricks"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="Wall"><mesh>
<source id="p"><float_array id="pa" count="15">0 0 0 1 0 0 1 1 0 0 1 0 2 0 0</float_array><technique_common>
<accessor source="#pa" count="5" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common>
<accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="s" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#u" offset="1" set="0"/><vcount>4 3</vcount>
<p>0 0 1 1 2 2 3 3 1 0 4 1 2 3</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node id="House" name="House"><instance_geometry url="#g">
<bind_material><technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>)";
}

TEST_F(AssimpScene, BringsAttributesPolygonsPartsAndMaterials) {
  const OpenedSource opened = open_file(folder_.write("wall.dae", textured_collada()));
  const MeshProperties& properties = opened.source->properties();
  EXPECT_EQ(opened.source->mesh().vertex_count, 5U);
  EXPECT_THAT(properties.polygons, ElementsAre(Polygon{0, 4}));
  ASSERT_EQ(properties.attributes.size(), 1U);
  const Attribute& uv = properties.attributes[0];
  EXPECT_EQ(uv.name, "TEXCOORD_0");
  EXPECT_EQ(uv.domain, AttributeDomain::kCorner);
  std::vector<float> corners;
  for (const std::uint32_t value : uv.corners)
    corners.insert(corners.end(), {uv.values[2 * value], uv.values[2 * value + 1]});
  EXPECT_THAT(corners, ElementsAre(0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1, 0, 0, 1, 0, 0, 1));
  ASSERT_EQ(properties.parts.size(), 1U);
  EXPECT_EQ(properties.parts[0].object, "House");
  EXPECT_EQ(properties.parts[0].material, "Bricks");
  ASSERT_EQ(opened.source->data().size(), 1U);
  const NamedData& data = opened.source->data()[0];
  EXPECT_EQ(data.name, "materials");
  const auto json = nlohmann::json::parse(data.bytes.begin(), data.bytes.end());
  EXPECT_EQ(json["materials"][0]["name"], "Bricks");
  EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  EXPECT_EQ(json["images"][0]["uri"], "bricks.png");
}

TEST_F(AssimpScene, CutsPolygonsAroundACornerThatSeesAllOthers) {
  std::string text = textured_collada();
  // An arrow's head: of the first two corners only the one that goes in sees all others.
  const std::string square = "0 0 0 1 0 0 1 1 0 0 1 0 2 0 0";
  text.replace(text.find(square), square.size(), "1 -1 0 0.5 0 0 1 1 0 0 0 0 2 0 0");
  const OpenedSource opened = open_file(folder_.write("wall.dae", text));
  EXPECT_THAT(opened.source->properties().polygons, ElementsAre(Polygon{0, 4}));
  EXPECT_THAT(opened.source->mesh().faces[0], Contains(1U));
  EXPECT_THAT(opened.source->mesh().faces[1], Contains(1U));
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
