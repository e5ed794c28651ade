#include "tests/importers/scene_fixture.hpp"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>

// What scenes bring beside positions.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pointwise;

class SceneProperties : public Scenes {
 protected:
  OpenedSource open_with(GltfBuilder& gltf, const PropertyOptions& properties,
                         const SceneOptions& scene = {}) {
    SourceSpec spec{{folder_.write("scene.gltf", gltf.text())}};
    spec.scene = scene;
    spec.sequence.properties = properties;
    return open_source(spec);
  }
};

const Attribute* find(const FrameSource& source, const std::string& name) {
  for (const Attribute& attribute : source.properties().attributes) {
    if (attribute.name == name) return &attribute;
  }
  return nullptr;
}

std::string data_of(const FrameSource& source, const std::string& name) {
  for (const NamedData& data : source.data()) {
    if (data.name == name) return {data.bytes.begin(), data.bytes.end()};
  }
  return "";
}

nlohmann::json json_of(const FrameSource& source, const std::string& name) {
  const std::string text = data_of(source, name);
  return text.empty() ? nlohmann::json() : nlohmann::json::parse(text);
}

nlohmann::json& attributes_of(GltfBuilder& gltf) {
  return gltf.json["meshes"][0]["primitives"][0]["attributes"];
}

/// Two triangles that share the edge from (0, 0) to (1, 1), whose ends stand in the file twice.
GltfBuilder split_square() {
  GltfBuilder gltf;
  set_mesh(gltf, gltf.primitive({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 3, 4, 5}));
  return gltf;
}

TEST_F(SceneProperties, TextureCoordinatesPointUpAndHaveSeamsWhereTheyDiffer) {
  GltfBuilder gltf = split_square();
  attributes_of(gltf)["TEXCOORD_0"] =
      gltf.add<float>("VEC2", {0, 1, 0.5F, 1, 0.5F, 0.5F, 0, 0.25F, 0.5F, 0.5F, 0, 0});
  const OpenedSource opened = open(gltf);
  EXPECT_EQ(opened.source->mesh().vertex_count, 4U);
  const Attribute* const uv = find(*opened.source, "TEXCOORD_0");
  ASSERT_NE(uv, nullptr);
  EXPECT_EQ(uv->kind, AttributeKind::kTexcoord);
  EXPECT_EQ(uv->domain, AttributeDomain::kCorner);
  EXPECT_EQ(uv->components, 2U);
  EXPECT_THAT(uv->corners, ElementsAre(0, 1, 2, 3, 2, 4));
  EXPECT_THAT(uv->values, ElementsAre(0, 0, 0.5F, 0, 0.5F, 0.5F, 0, 0.75F, 0, 1));
}

TEST_F(SceneProperties, AttributesWithoutSeamsAreOfVertices) {
  GltfBuilder gltf = split_square();
  attributes_of(gltf)["TEXCOORD_1"] = gltf.add_normalized<std::uint16_t>(
      "VEC2", {0, 65535, 65535, 65535, 65535, 0, 0, 65535, 65535, 0, 0, 0});
  const OpenedSource opened = open(gltf);
  const Attribute* const uv = find(*opened.source, "TEXCOORD_1");
  ASSERT_NE(uv, nullptr);
  EXPECT_EQ(uv->domain, AttributeDomain::kVertex);
  EXPECT_THAT(uv->corners, IsEmpty());
  EXPECT_THAT(uv->values, ElementsAre(0, 0, 1, 0, 1, 1, 0, 1));
}

TEST_F(SceneProperties, ColoursAreFromZeroToOneWhateverTheirType) {
  GltfBuilder gltf = one_triangle();
  attributes_of(gltf)["COLOR_0"] =
      gltf.add_normalized<std::uint8_t>("VEC4", {255, 0, 51, 255, 0, 0, 0, 0, 255, 255, 255, 102});
  attributes_of(gltf)["COLOR_1"] =
      gltf.add_normalized<std::uint16_t>("VEC3", {65535, 0, 13107, 0, 0, 0, 1, 1, 1});
  const OpenedSource opened = open(gltf);
  const Attribute* const bytes = find(*opened.source, "COLOR_0");
  const Attribute* const shorts = find(*opened.source, "COLOR_1");
  ASSERT_NE(bytes, nullptr);
  ASSERT_NE(shorts, nullptr);
  EXPECT_EQ(bytes->kind, AttributeKind::kColour);
  EXPECT_THAT(bytes->values, ElementsAre(1, 0, 0.2F, 1, 0, 0, 0, 0, 1, 1, 1, 0.4F));
  EXPECT_EQ(shorts->components, 3U);
  EXPECT_FLOAT_EQ(shorts->values[2], 0.2F);
}

TEST_F(SceneProperties, NumbersOfApplicationsComeByTheirNamesAsTheyAre) {
  GltfBuilder gltf = one_triangle();
  attributes_of(gltf)["_TEMPERATURE"] = gltf.add<float>("SCALAR", {-3, 20.5F, 1e6F});
  attributes_of(gltf)["_ID"] = gltf.add<std::uint16_t>("SCALAR", {7, 8, 65535});
  const OpenedSource opened = open(gltf);
  const Attribute* const temperature = find(*opened.source, "_TEMPERATURE");
  ASSERT_NE(temperature, nullptr);
  EXPECT_EQ(temperature->kind, AttributeKind::kGeneric);
  EXPECT_THAT(temperature->values, ElementsAre(-3, 20.5F, 1e6F));
  ASSERT_NE(find(*opened.source, "_ID"), nullptr);
  EXPECT_THAT(find(*opened.source, "_ID")->values, ElementsAre(7, 8, 65535));
}

TEST_F(SceneProperties, AttributesThatCannotBeReadAreLeftOutWithANote) {
  GltfBuilder gltf = one_triangle();
  attributes_of(gltf)["TEXCOORD_0"] = gltf.add<float>("VEC2", {0, 0});
  attributes_of(gltf)["COLOR_0"] = 77;
  attributes_of(gltf)["_NAN"] = gltf.add<float>("SCALAR", {0, NAN, 0});
  attributes_of(gltf)["TANGENT"] = gltf.add<float>("VEC4", {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
  const OpenedSource opened = open(gltf);
  EXPECT_THAT(opened.source->properties().attributes, IsEmpty());
  EXPECT_THAT(opened.notes, Contains(HasSubstr("TEXCOORD_0 is for 1 vertices of 3: it is left out")));
  EXPECT_THAT(opened.notes, Contains(HasSubstr("COLOR_0 is in accessor 77")));
  EXPECT_THAT(opened.notes, Contains(HasSubstr("_NAN")));
  EXPECT_THAT(opened.notes, Contains(HasSubstr("tangents are left to the player")));
  ASSERT_EQ(read_all(*opened.source).frames.size(), 1U);
}

TEST_F(SceneProperties, NormalsOfAStillMeshAreTurnedWithItsNode) {
  GltfBuilder gltf = one_triangle();
  attributes_of(gltf)["NORMAL"] =
      gltf.add_normalized<std::int8_t>("VEC3", {127, 0, 0, 0, 127, 0, 127, 127, 0});
  gltf.json["nodes"][0]["rotation"] = {0, 0, kHalf, kHalf};
  gltf.json["nodes"][0]["scale"] = {2, 1, 1};
  const OpenedSource opened = open(gltf);
  const Attribute* const normals = find(*opened.source, "NORMAL");
  ASSERT_NE(normals, nullptr);
  const float five = std::sqrt(5.0F);
  EXPECT_THAT(normals->values,
              Pointwise(FloatNear(1e-6F), {0.0F, 1.0F, 0.0F, -1.0F, 0.0F, 0.0F, -2 / five, 1 / five, 0.0F}));
}

TEST_F(SceneProperties, NormalsThatFacesGiveAreLeftToThePlayerUnlessTheyAreToBeKept) {
  GltfBuilder gltf = one_triangle();
  attributes_of(gltf)["NORMAL"] = gltf.add<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  const OpenedSource opened = open(gltf);
  EXPECT_EQ(find(*opened.source, "NORMAL"), nullptr);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("normals are left out: they are what the faces give")));
  EXPECT_NE(find(*open_with(gltf, {.normals = NormalsChoice::kKeep}).source, "NORMAL"), nullptr);
  attributes_of(gltf)["NORMAL"] = gltf.add<float>("VEC3", {1, 0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_NE(find(*open(gltf).source, "NORMAL"), nullptr);
  EXPECT_EQ(find(*open_with(gltf, {.normals = NormalsChoice::kDrop}).source, "NORMAL"), nullptr);
}

TEST_F(SceneProperties, NormalsOfAMeshThatMovesAreLeftToThePlayer) {
  GltfBuilder gltf = skinned_strip();
  std::vector<float> normals;
  for (int vertex = 0; vertex < 6; ++vertex) normals.insert(normals.end(), {1, 0, 0});
  attributes_of(gltf)["NORMAL"] = gltf.add("VEC3", normals);
  const OpenedSource opened = open(gltf);
  EXPECT_EQ(find(*opened.source, "NORMAL"), nullptr);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("the mesh moves")));
  const OpenedSource kept = open_with(gltf, {.normals = NormalsChoice::kKeep});
  ASSERT_NE(find(*kept.source, "NORMAL"), nullptr);
  EXPECT_FALSE(find(*kept.source, "NORMAL")->animated);
}

TEST_F(SceneProperties, PartsAreNodesMeshesAndMaterials) {
  GltfBuilder gltf = two_triangles();
  gltf.json["materials"] = {{{"name", "Skin"}}, {{"name", "Skin"}}, nlohmann::json::object()};
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  gltf.json["meshes"][1]["primitives"][0]["material"] = 1;
  gltf.json["meshes"][1]["primitives"].push_back(gltf.json["meshes"][1]["primitives"][0]);
  gltf.json["meshes"][1]["primitives"][1].erase("material");
  const OpenedSource opened = open(gltf);
  const MeshProperties& properties = opened.source->properties();
  EXPECT_THAT(properties.parts,
              ElementsAre(Part{"LeftNode", "LeftMesh", "Skin"}, Part{"RightNode", "RightMesh", "Skin 1"},
                          Part{"RightNode", "RightMesh", ""}));
  EXPECT_THAT(properties.face_parts, ElementsAre(0, 1, 2));
  const nlohmann::json materials = json_of(*opened.source, "materials")["materials"];
  ASSERT_EQ(materials.size(), 3U);
  EXPECT_EQ(materials[1]["name"], "Skin 1");
  EXPECT_EQ(materials[2]["name"], "material 2");
}

TEST_F(SceneProperties, WhatAPartHasNotIsFilledUp) {
  GltfBuilder gltf = two_triangles();
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
      gltf.add<float>("VEC3", {1, 0, 0, 1, 0, 0, 1, 0, 0});
  gltf.json["meshes"][1]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      gltf.add<float>("VEC2", {1, 0, 1, 0, 1, 0});
  const OpenedSource opened = open(gltf);
  ASSERT_NE(find(*opened.source, "COLOR_0"), nullptr);
  EXPECT_THAT(find(*opened.source, "COLOR_0")->values,
              ElementsAre(1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1));
  ASSERT_NE(find(*opened.source, "TEXCOORD_0"), nullptr);
  EXPECT_THAT(find(*opened.source, "TEXCOORD_0")->values, ElementsAre(0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1));
}

TEST_F(SceneProperties, MaterialsComeAsTheyAreAndPicturesWithinAsData) {
  GltfBuilder gltf = one_triangle();
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  gltf.json["materials"] = {
      {{"name", "Wood"},
       {"pbrMetallicRoughness",
        {{"baseColorTexture",
          {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 3}}}}}}}}}},
       {"extensions", {{"KHR_materials_sheen", {{"sheenRoughnessFactor", 0.5}}}}}}};
  gltf.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}, {{"source", 2}}};
  gltf.json["samplers"] = {{{"wrapS", 33071}}};
  gltf.json["images"] = {
      {{"uri", "wood.png"}},
      {{"name", "grain"}, {"bufferView", gltf.add_view("PNG1")}, {"mimeType", "image/png"}},
      {{"uri", "data:image/jpeg;base64," + base64("JPEG2")}}};
  const nlohmann::json wanted = gltf.json["materials"];
  const OpenedSource opened = open(gltf);
  const nlohmann::json found = json_of(*opened.source, "materials");
  EXPECT_EQ(found["materials"], wanted);
  EXPECT_EQ(found["samplers"], gltf.json["samplers"]);
  EXPECT_EQ(found["textures"], gltf.json["textures"]);
  EXPECT_EQ(found["images"][0]["uri"], "wood.png");
  EXPECT_EQ(found["images"][1]["extras"]["data"], "image/grain");
  EXPECT_FALSE(found["images"][1].contains("bufferView"));
  EXPECT_EQ(data_of(*opened.source, "image/grain"), "PNG1");
  const std::string embedded = found["images"][2]["extras"]["data"];
  EXPECT_EQ(found["images"][2]["mimeType"], "image/jpeg");
  EXPECT_EQ(data_of(*opened.source, embedded), "JPEG2");
}

TEST_F(SceneProperties, PicturesBesideTheFileAreTakenIntoTheStreamWhereThatIsAskedFor) {
  GltfBuilder gltf = one_triangle();
  gltf.json["materials"] = {{{"name", "Wood"}}};
  gltf.json["images"] = {{{"uri", "wood.png"}}, {{"uri", "../secret.png"}}};
  folder_.write("wood.png", "WOOD");
  const OpenedSource opened = open_with(gltf, {.embed_textures = true});
  const nlohmann::json found = json_of(*opened.source, "materials");
  EXPECT_EQ(data_of(*opened.source, found["images"][0]["extras"]["data"]), "WOOD");
  EXPECT_FALSE(found["images"][1].contains("extras"));
  EXPECT_THAT(opened.notes, Contains(HasSubstr("outside of its folder")));
}

TEST_F(SceneProperties, PicturesThatAreNotThereAreLeftOutWithANote) {
  GltfBuilder gltf = one_triangle();
  gltf.json["materials"] = {{{"name", "Wood"}}};
  gltf.json["images"] = {{{"bufferView", 99}}, {{"uri", "data:image/png;base64,###"}}};
  const OpenedSource opened = open(gltf);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("view 99 is named")));
  EXPECT_THAT(opened.notes, Contains(HasSubstr("image 1 is not well-formed base64")));
  EXPECT_EQ(opened.source->data().size(), 1U);
}

TEST_F(SceneProperties, ExtrasOfSceneNodesAndMeshesAreKept) {
  GltfBuilder gltf = one_triangle();
  gltf.json["scenes"][0]["extras"] = {{"author", "somebody"}};
  gltf.json["nodes"][0]["extras"] = 7;
  gltf.json["meshes"][0]["extras"] = {{"targetNames", {"smile"}}};
  const nlohmann::json extras = json_of(*open(gltf).source, "extras");
  EXPECT_EQ(extras["scene"]["author"], "somebody");
  EXPECT_EQ(extras["nodes"][0], nlohmann::json({{"index", 0}, {"name", "ThingNode"}, {"extras", 7}}));
  EXPECT_EQ(extras["meshes"][0]["extras"]["targetNames"][0], "smile");
}

TEST_F(SceneProperties, OfPositionsAloneThereIsNothingElse) {
  GltfBuilder gltf = split_square();
  attributes_of(gltf)["TEXCOORD_0"] = gltf.add<float>("VEC2", {0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 1, 1});
  gltf.json["materials"] = {{{"name", "Wood"}}};
  const OpenedSource opened = open_with(gltf, {.wanted = false});
  EXPECT_TRUE(opened.source->properties().empty());
  EXPECT_THAT(opened.source->data(), IsEmpty());
  EXPECT_EQ(opened.source->mesh().vertex_count, 4U);
}

TEST_F(SceneProperties, TheSkeletonIsKeptWhereThatIsAskedForAndElseANoteSaysSo) {
  GltfBuilder gltf = skinned_strip();
  EXPECT_THAT(open(gltf).notes, Contains(HasSubstr("--skeleton-data")));
  SourceSpec spec{{folder_.write("scene.gltf", gltf.text())}};
  spec.scene.fps = "2";
  spec.scene.skeleton_data = true;
  spec.frames = FrameRange{1, 2};
  const OpenedSource opened = open_source(spec);
  const nlohmann::json joints = json_of(*opened.source, "skeleton")["joints"];
  EXPECT_EQ(joints,
            nlohmann::json({{{"name", "Lower"}, {"parent", -1}}, {{"name", "Upper"}, {"parent", 0}}}));
  const std::string track = data_of(*opened.source, "skeleton/positions");
  ASSERT_EQ(track.size(), 2U * 2U * 12U);
  std::vector<float> places(12);
  std::memcpy(places.data(), track.data(), track.size());
  EXPECT_THAT(places, ElementsAre(10, 0, 0, 10, 1, 0, 10, 0, 0, 10, 1, 0));
  EXPECT_THAT(opened.notes, Not(Contains(HasSubstr("--skeleton-data"))));
}

}  // namespace
}  // namespace tvg::cli
