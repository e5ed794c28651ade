#include "encoder/importers/scene_summary.hpp"
#include "tests/importers/scene_fixture.hpp"

#include <gmock/gmock.h>

// Nodes, meshes and skins of glTF, which are known by their numbers.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using GltfScene = Scenes;

/// The triangle twice, in two nodes of one name, of which the second moves.
GltfBuilder two_of_a_name() {
  GltfBuilder gltf = one_triangle();
  gltf.json["nodes"] = {{{"name", "same"}, {"mesh", 0}},
                        {{"name", "same"}, {"mesh", 0}, {"translation", {5, 0, 0}}}};
  gltf.animate(0, 1, "translation", {0, 1}, "VEC3", {5, 0, 0, 7, 0, 0});
  set_roots(gltf, {0, 1});
  return gltf;
}

TEST_F(GltfScene, MovesTheNodeThatIsMeantWhereNamesAreTheSame) {
  GltfBuilder gltf = two_of_a_name();
  const std::vector<FramePositions> read = frames(gltf, "1");
  expect_vertex(read.at(1), 0, 0, 0, 0);
  expect_vertex(read.at(1), 3, 7, 0, 0);
}

TEST_F(GltfScene, BindsToTheJointThatIsMeantWhereNamesAreTheSame) {
  GltfBuilder gltf = skinned_strip();
  for (nlohmann::json& node : gltf.json["nodes"]) node["name"] = "bone";
  const OpenedSource opened = open(gltf, {"", {}, "2"});
  expect_vertex(read_all(*opened.source).frames.at(2), 5, 9, 2, 0);
  EXPECT_THAT(opened.source->skeleton().joint_names, ElementsAre("bone", "bone"));
}

TEST_F(GltfScene, NamesWhatANameLeavesOpen) {
  GltfBuilder gltf = two_of_a_name();
  EXPECT_THAT(open(gltf, {"", {"same"}, ""}).notes,
              Contains(HasSubstr("--mesh same: several have that name")));
  GltfBuilder clips = two_triangles();
  clips.json["animations"][1]["name"] = "walk";
  const ToolError error = refusal(clips, {"walk", {}, ""});
  EXPECT_EQ(error.status(), ExitStatus::kUsage);
  EXPECT_THAT(error.what(), HasSubstr("2 clips of"));
  EXPECT_THAT(error.what(), HasSubstr("say which by its number: 0, 1"));
  EXPECT_EQ(read_all(*open(clips, {"1", {}, "2"}).source).frames.size(), 2U);
}

TEST_F(GltfScene, TakesAMeshByItsNumber) {
  GltfBuilder gltf = two_triangles();
  const Frames read = read_all(*open(gltf, {"", {"1"}, "2"}).source);
  ASSERT_EQ(read.frames.at(0).size(), 9U);
  expect_vertex(read.frames[0], 0, 14, 0, 0);
  EXPECT_THAT(refusal(gltf, {"", {"2"}, ""}).what(), HasSubstr("no mesh of that name or number"));
}

TEST_F(GltfScene, ASkinWithoutMatricesBindsWhereItsMeshIs) {
  GltfBuilder gltf = skinned_strip();
  gltf.json["skins"][0].erase("inverseBindMatrices");
  gltf.json["nodes"][3]["translation"] = {0, 0, 0};
  const std::vector<FramePositions> read = frames(gltf, "2");
  expect_vertex(read.at(0), 5, 11, 2, 0);
  expect_vertex(read.at(2), 5, 8, 1, 0);
}

TEST_F(GltfScene, ASkinWithTooFewMatricesIsRefused) {
  GltfBuilder gltf = skinned_strip();
  gltf.json["skins"][0]["joints"] = {2, 3, 1};
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("skin 0, inverseBindMatrices has 2 matrices for 3 joints"));
  gltf.json["skins"][0]["joints"] = {2, 9};
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("skin 0 has the joint 9, and there are 4 nodes"));
  gltf.json["skins"][0]["joints"] = {2};
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("vertex 2 has a weight of joint 1, and its skin has 1"));
}

TEST_F(GltfScene, AMeshMayHaveASkinForEachOfItsNodes) {
  GltfBuilder gltf = skinned_strip();
  gltf.json["nodes"].push_back({{"name", "Other"}, {"translation", {20, 0, 0}}});
  gltf.json["nodes"].push_back({{"name", "Twin"}, {"mesh", 0}, {"skin", 1}});
  gltf.json["nodes"].push_back({{"name", "Again"}, {"mesh", 0}, {"skin", 0}});
  gltf.json["skins"].push_back({{"joints", {4, 4}}});
  set_roots(gltf, {0, 1, 4, 5, 6});
  const OpenedSource opened = open(gltf, {"", {}, "2"});
  // Once for each skin, and not for each node.
  ASSERT_EQ(opened.source->mesh().vertex_count, 12U);
  const Frames read = read_all(*opened.source);
  expect_vertex(read.frames.at(2), 5, 9, 2, 0);
  expect_vertex(read.frames.at(2), 11, 21, 2, 0);
}

TEST_F(GltfScene, MorphsBeforeItBinds) {
  GltfBuilder gltf = skinned_strip();
  std::vector<float> shift(18, 0);
  shift[15] = 1;  // vertex 5 by 1 along x
  gltf.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", gltf.add<float>("VEC3", shift)}}};
  gltf.json["nodes"][0]["weights"] = {1};
  const std::vector<FramePositions> read = frames(gltf, "2");
  expect_vertex(read.at(0), 5, 12, 2, 0);
  expect_vertex(read.at(2), 5, 9, 3, 0);
}

TEST_F(GltfScene, WeightsOfANodeGoBeforeThoseOfItsMesh) {
  GltfBuilder gltf = morphing_triangle();
  gltf.json["nodes"][0]["weights"] = {0.5, 1};
  const FramePositions read = frames(gltf, "1").at(0);
  expect_vertex(read, 1, 3, 0, 1);
  expect_vertex(read, 2, 0, 1, 5);
}

TEST_F(GltfScene, MovesMorphTargetsOfOneNodeOnly) {
  GltfBuilder gltf = morphing_triangle();
  gltf.json["nodes"].push_back({{"name", "FaceNode"}, {"mesh", 0}});
  set_roots(gltf, {0, 1});
  gltf.animate(0, 0, "weights", {0, 1}, "SCALAR", {0, 0, 1, 0});
  const FramePositions last = frames(gltf, "1").at(1);
  expect_vertex(last, 2, 0, 1, 9);
  expect_vertex(last, 5, 0, 1, 2);  // the weight of the mesh, 0.25
}

TEST_F(GltfScene, TurnsFacesThatANodeMirrors) {
  GltfBuilder gltf = one_triangle();
  gltf.json["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(open(gltf).source->mesh().faces, (std::vector<Face>{{0, 2, 1}}));
  gltf.json["nodes"][0]["scale"] = {-1, -1, 1};
  EXPECT_EQ(open(gltf).source->mesh().faces, (std::vector<Face>{{0, 1, 2}}));
  gltf.json["nodes"].push_back({{"name", "Mirror"}, {"children", {0}}, {"scale", {1, 1, -1}}});
  set_roots(gltf, {1});
  EXPECT_EQ(open(gltf).source->mesh().faces, (std::vector<Face>{{0, 2, 1}}));
}

TEST_F(GltfScene, ReadsEveryShapeOfTriangles) {
  GltfBuilder gltf;
  const int positions = gltf.add<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  const auto faces = [&](int mode) {
    set_mesh(gltf, {{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
    return open(gltf).source->mesh().faces;
  };
  EXPECT_EQ(faces(4), (std::vector<Face>{{0, 1, 2}}));
  EXPECT_EQ(faces(5), (std::vector<Face>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(faces(6), (std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  for (const int mode : {0, 1, 2, 3}) {
    set_mesh(gltf, {{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
    EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("its meshes have no faces to encode"));
  }
  set_mesh(gltf, {{"attributes", {{"POSITION", positions}}}, {"mode", 7}});
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("mesh \"Thing\" has the mode 7"));
}

TEST_F(GltfScene, LeavesOutPointsAndLinesWithANote) {
  GltfBuilder gltf = one_triangle();
  nlohmann::json& primitives = gltf.json["meshes"][0]["primitives"];
  for (const int mode : {0, 1, 2, 3}) {
    nlohmann::json other = primitives[0];
    other["mode"] = mode;
    primitives.push_back(other);
  }
  const OpenedSource opened = open(gltf);
  EXPECT_EQ(opened.source->mesh().faces.size(), 1U);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("9 points and lines left out")));
}

TEST_F(GltfScene, TakesTheMeshesOfItsSceneOnly) {
  GltfBuilder gltf = two_triangles();
  gltf.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {2}}}};
  gltf.json["nodes"][0]["children"] = {1};
  gltf.json["scene"] = 1;
  const OpenedSource opened = open(gltf);
  EXPECT_EQ(opened.source->mesh().vertex_count, 3U);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("scene 1 of 2 is taken")));
  gltf.json["scene"] = 2;
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("scene 2 is to be shown, and there are 2"));
  gltf.json.erase("scenes");
  EXPECT_EQ(open(gltf).source->mesh().vertex_count, 6U);
}

TEST_F(GltfScene, RefusesNodesThatGoRound) {
  GltfBuilder gltf = one_triangle();
  gltf.json["nodes"].push_back({{"children", {2}}});
  gltf.json["nodes"].push_back({{"children", {1}}});
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("node 1 is among those below it"));
  gltf.json["nodes"][2]["children"] = {0};
  gltf.json["nodes"][1]["children"] = {0};
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("node 0 has two parents"));
  gltf.json["nodes"][1]["children"] = {8};
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("node 1 has the node 8, and there are 3"));
}

TEST_F(GltfScene, ReadsAChainOfNodesOfAnyLength) {
  GltfBuilder gltf = one_triangle();
  constexpr int kNodes = 20000;
  for (int node = 1; node < kNodes; ++node) {
    gltf.json["nodes"].push_back({{"children", {node - 1}}, {"translation", {0.5, 0, 0}}});
  }
  set_roots(gltf, {kNodes - 1});
  EXPECT_NEAR(frames(gltf, "1").at(0)[0], 0.5 * (kNodes - 1), 1e-3);
}

TEST_F(GltfScene, RefusesExtensionsThatItRequiresAndThatAreNotRead) {
  GltfBuilder gltf = one_triangle();
  for (const std::string name : {"VENDOR_unknown", "KHR_node_visibility", "KHR_animation_pointer"}) {
    gltf.json["extensionsRequired"] = {name};
    const ToolError error = refusal(gltf, {});
    EXPECT_EQ(error.status(), ExitStatus::kInvalidInput);
    EXPECT_THAT(error.what(), HasSubstr("it requires the extension " + name));
  }
  gltf.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("export it without Draco's compression"));
  gltf.json["extensionsRequired"] = {"KHR_texture_transform", "KHR_materials_unlit", "KHR_mesh_quantization",
                                     "KHR_texture_basisu", "KHR_lights_punctual"};
  EXPECT_THAT(open(gltf).notes, ElementsAre(HasSubstr("holds no clip")));
}

TEST_F(GltfScene, NotesExtensionsThatWouldPlaceVertices) {
  GltfBuilder gltf = one_triangle();
  gltf.json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_materials_unlit"};
  EXPECT_THAT(open(gltf).notes,
              Contains(HasSubstr("KHR_animation_pointer is passed over: what only it moves")));
  EXPECT_THAT(summarize_scene(folder_.write("a.gltf", gltf.text()), 30).notes,
              ElementsAre(HasSubstr("KHR_animation_pointer")));
}

TEST_F(GltfScene, StandsAsOftenAsItsNodeSays) {
  GltfBuilder gltf = one_triangle();
  nlohmann::json& attributes = gltf.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["TRANSLATION"] = gltf.add<float>("VEC3", {0, 0, 0, 3, 0, 0, 0, 0, 5});
  attributes["ROTATION"] =
      gltf.add_normalized<std::int16_t>("VEC4", {0, 0, 0, 32767, 0, 0, 32767, 0, 0, 0, 0, 32767});
  attributes["SCALE"] = gltf.add<float>("VEC3", {1, 1, 1, 2, 2, 2, 1, 1, -1});
  gltf.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  gltf.animate(0, 0, "translation", {0, 1}, "VEC3", {0, 0, 0, 0, 7, 0});
  const OpenedSource opened = open(gltf, {"", {}, "1"});
  const FramePositions last = read_all(*opened.source).frames.at(1);
  ASSERT_EQ(last.size(), 27U);
  expect_vertex(last, 1, 1, 7, 0);
  expect_vertex(last, 4, 1, 7, 0);
  expect_vertex(last, 5, 3, 5, 0);
  expect_vertex(last, 7, 1, 7, 5);
  EXPECT_EQ(opened.source->mesh().faces, (std::vector<Face>{{0, 1, 2}, {3, 4, 5}, {6, 8, 7}}));
  attributes["SCALE"] = gltf.add<float>("VEC3", {1, 1, 1});
  EXPECT_THAT(refusal(gltf, {}).what(),
              HasSubstr("SCALE of EXT_mesh_gpu_instancing has 1 elements where others have 3"));
  const int many = gltf.add_accessor({{"componentType", 5126}, {"count", 80000000}, {"type", "VEC3"}});
  attributes = {{"TRANSLATION", many}};
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("has 80000000 elements"));
}

TEST_F(GltfScene, SaysWhichMeshDracoHasCompressed) {
  GltfBuilder gltf = one_triangle();
  nlohmann::json& primitive = gltf.json["meshes"][0]["primitives"][0];
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                           {"attributes", {{"POSITION", 0}}}};
  // Not required: what is there without it is read.
  EXPECT_EQ(open(gltf).source->mesh().faces.size(), 1U);
  gltf.json["accessors"][0].erase("bufferView");
  EXPECT_THAT(refusal(gltf, {}).what(),
              HasSubstr("mesh \"Thing\" is compressed by KHR_draco_mesh_compression"));
}

TEST_F(GltfScene, HasMaterialsAndPicturesThatDoNotMatter) {
  GltfBuilder gltf = one_triangle();
  gltf.json["images"] = {{{"uri", "missing.png"}}, {{"uri", 7}}};
  gltf.json["textures"] = {{{"source", 9}}};
  gltf.json["materials"] = {{{"pbrMetallicRoughness", "none"}}};
  gltf.json["buffers"][1] = {{"byteLength", 9}, {"uri", "missing.bin"}};
  EXPECT_EQ(open(gltf).source->mesh().faces.size(), 1U);
}

}  // namespace
}  // namespace tvg::cli
