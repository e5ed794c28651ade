#include "encoder/importers/scene_summary.hpp"
#include "tests/importers/scene_fixture.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(Scenes, BlendsASkinLinearlyAndTurnsAlongTheArc) {
  GltfBuilder gltf = skinned_strip();
  const OpenedSource opened = open(gltf, {"", {}, "2"});
  EXPECT_EQ(opened.source->frame_count(), 3U);
  for (int pass = 0; pass < 2; ++pass) {
    const Frames read = read_all(*opened.source);
    ASSERT_EQ(read.frames.size(), 3U);
    expect_vertex(read.frames[0], 3, 11, 1, 0);
    expect_vertex(read.frames[0], 5, 11, 2, 0);
    // Half way: 45 degrees about (10, 1). The middle row moves with both bones by halves.
    expect_vertex(read.frames[1], 1, 11, 0, 0);
    expect_vertex(read.frames[1], 2, 10, 1, 0);
    expect_vertex(read.frames[1], 3, 10 + (1 + kHalf) / 2, 1 + kHalf / 2, 0);
    expect_vertex(read.frames[1], 4, 10 - kHalf, 1 + kHalf, 0);
    expect_vertex(read.frames[1], 5, 10, 1 + 2 * kHalf, 0);
    expect_vertex(read.frames[2], 4, 9, 1, 0);
    expect_vertex(read.frames[2], 5, 9, 2, 0);
    EXPECT_TRUE(opened.source->rewind());
  }
  const Metadata metadata = opened.source->metadata();
  EXPECT_EQ(metadata, (Metadata{{"fps", "2"}, {"name", "bend"}, {"units", "m"}, {"up", "y"}}));
}

TEST_F(Scenes, BringsItsSkeletonAlong) {
  GltfBuilder gltf = skinned_strip();
  gltf.animate(0, 2, "translation", {0, 1}, "VEC3", {0, 0, 0, 0, 0, 4});
  SourceSpec spec{{folder_.write("scene.gltf", gltf.text())}, FrameRange{1, 2}};
  spec.scene.fps = "2";
  const OpenedSource opened = open_source(spec);
  const Skeleton& skeleton = opened.source->skeleton();
  EXPECT_THAT(skeleton.joint_names, ElementsAre("Lower", "Upper"));
  EXPECT_THAT(skeleton.parents, ElementsAre(-1, 0));
  EXPECT_THAT(skeleton.heaviest_joint, ElementsAre(0, 0, 0, 0, 1, 1));
  FramePositions positions(18);
  ASSERT_TRUE(*opened.source->read_frame(positions));
  EXPECT_THAT(opened.source->joint_positions(), ElementsAre(10, 0, 2, 10, 1, 2));
  ASSERT_TRUE(*opened.source->read_frame(positions));
  EXPECT_THAT(opened.source->joint_positions(), ElementsAre(10, 0, 4, 10, 1, 4));
  EXPECT_FALSE(*opened.source->read_frame(positions));
}

TEST_F(Scenes, AddsMorphTargetsByTheirWeights) {
  GltfBuilder gltf = morphing_triangle();
  gltf.animate(0, 0, "weights", {0, 1}, "SCALAR", {0, 1, 1, 0});
  const OpenedSource opened = open(gltf, {"", {}, "4"});
  const Frames read = read_all(*opened.source);
  ASSERT_EQ(read.frames.size(), 5U);
  for (std::size_t frame = 0; frame < 5; ++frame) {
    const float share = 0.25F * static_cast<float>(frame);
    expect_vertex(read.frames[frame], 0, 0, 0, 1);
    expect_vertex(read.frames[frame], 1, 1 + 2 * (1 - share), 0, 1);
    expect_vertex(read.frames[frame], 2, 0, 1, 1 + 8 * share);
  }
}

TEST_F(Scenes, WithoutAClipIsOneFrameWithTheWeightsItHas) {
  GltfBuilder gltf = morphing_triangle();
  const OpenedSource opened = open(gltf);
  const Frames read = read_all(*opened.source);
  ASSERT_EQ(read.frames.size(), 1U);
  expect_vertex(read.frames[0], 2, 0, 1, 3);
  EXPECT_THAT(opened.notes, ElementsAre(HasSubstr("holds no clip")));
  EXPECT_TRUE(opened.source->skeleton().empty());
  EXPECT_THAT(refusal(gltf, {"walk", {}, ""}).what(), HasSubstr("it has no clips at all"));
}

TEST_F(Scenes, MovesNodesOfMeshesWithoutASkin) {
  GltfBuilder gltf = two_triangles();
  const OpenedSource opened = open(gltf, {"", {}, "2"});
  const Frames read = read_all(*opened.source);
  ASSERT_EQ(read.frames.size(), 3U);
  expect_vertex(read.frames[1], 0, 4, 0, 0);
  expect_vertex(read.frames[1], 1, 6, 0, 0);
  expect_vertex(read.frames[2], 0, 8, 0, 0);
  expect_vertex(read.frames[2], 3, 14, 0, 0);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("clip \"walk\" is taken; --clip picks another: \"jump\"")));
  EXPECT_THAT(opened.notes, Contains(HasSubstr("2 meshes merged into one")));
  EXPECT_EQ(opened.source->mesh().faces, (std::vector<Face>{{0, 1, 2}, {3, 5, 4}}));
}

TEST_F(Scenes, TakesTheClipThatIsNamedOrNumbered) {
  GltfBuilder gltf = two_triangles();
  for (const std::string clip : {"jump", "1"}) {
    const OpenedSource opened = open(gltf, {clip, {}, "2"});
    const Frames read = read_all(*opened.source);
    ASSERT_EQ(read.frames.size(), 2U) << clip;
    expect_vertex(read.frames[0], 0, 0, 2, 0);
    expect_vertex(read.frames[1], 0, 0, 6, 0);
    EXPECT_EQ(opened.source->metadata().at("name"), "jump");
  }
  const ToolError error = refusal(gltf, {"run", {}, ""});
  EXPECT_EQ(error.status(), ExitStatus::kUsage);
  EXPECT_THAT(error.what(), HasSubstr("it has 0 \"walk\", 1 \"jump\""));
}

TEST_F(Scenes, TakesTheMeshesThatAreNamed) {
  GltfBuilder gltf = two_triangles();
  for (const std::string name : {"RightMesh", "RightNode"}) {
    const OpenedSource opened = open(gltf, {"", {name}, "2"});
    const Frames read = read_all(*opened.source);
    ASSERT_EQ(opened.source->mesh().vertex_count, 3U) << name;
    expect_vertex(read.frames[2], 0, 14, 0, 0);
  }
  EXPECT_EQ(open(gltf, {"", {"LeftNode", "RightMesh"}, ""}).source->mesh().vertex_count, 6U);
  const ToolError error = refusal(gltf, {"", {"LeftMesh", "Head"}, ""});
  EXPECT_EQ(error.status(), ExitStatus::kUsage);
  EXPECT_THAT(error.what(), AllOf(HasSubstr("--mesh Head"), HasSubstr("\"LeftMesh\"")));
}

TEST_F(Scenes, ShowsTheLastKeyInTheLastFrameWhateverTheRate) {
  GltfBuilder gltf = two_triangles();
  for (const auto& [fps, frames] : {std::pair("30", 31U), {"25", 26U}, {"1.5", 3U}, {"24000/1001", 25U}}) {
    const OpenedSource opened = open(gltf, {"walk", {}, fps});
    const Frames read = read_all(*opened.source);
    ASSERT_EQ(read.frames.size(), frames) << fps;
    expect_vertex(read.frames.front(), 0, 0, 0, 0);
    expect_vertex(read.frames.back(), 0, 8, 0, 0);
    EXPECT_EQ(opened.source->metadata().at("fps"), fps);
  }
}

TEST_F(Scenes, WeldsSeamsBetweenMaterialsAndLeavesApartWhatMovesApart) {
  GltfBuilder gltf = skinned_strip();
  // The same strip in two primitives: the middle row is in both, once with other weights on its right.
  nlohmann::json upper = gltf.primitive({0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0}, {0, 1, 3, 0, 3, 2});
  upper["attributes"]["JOINTS_0"] =
      gltf.add<std::uint8_t>("VEC4", {0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  upper["attributes"]["WEIGHTS_0"] =
      gltf.add<float>("VEC4", {0.5F, 0.5F, 0, 0, 0.25F, 0.75F, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  gltf.json["meshes"][0]["primitives"].push_back(upper);
  const OpenedSource opened = open(gltf);
  EXPECT_EQ(opened.source->mesh().vertex_count, 7U);
  EXPECT_THAT(opened.notes, Contains(HasSubstr("10 vertices welded to 7")));
  EXPECT_EQ(opened.source->mesh().faces.back(), (Face{2, 5, 4}));
  EXPECT_EQ(opened.source->mesh().faces[4], (Face{2, 6, 5}));
}

TEST_F(Scenes, ListsWhatItHolds) {
  GltfBuilder gltf = skinned_strip();
  const SceneSummary summary = summarize_scene(folder_.write("a.gltf", gltf.text()), 10);
  ASSERT_EQ(summary.clips.size(), 1U);
  EXPECT_EQ(summary.clips[0].name, "bend");
  EXPECT_NEAR(summary.clips[0].duration, 1, 1e-9);
  EXPECT_EQ(summary.clips[0].frames, 11U);
  EXPECT_EQ(summary.clips[0].channels, 1U);
  ASSERT_EQ(summary.meshes.size(), 1U);
  EXPECT_EQ(summary.meshes[0].vertices, 6U);
  EXPECT_EQ(summary.meshes[0].faces, 4U);
  EXPECT_EQ(summary.meshes[0].bones, 2U);
  EXPECT_THAT(summary.meshes[0].nodes, ElementsAre("StripNode"));
  EXPECT_THAT(summary.skeleton.joint_names, ElementsAre("Lower", "Upper"));
}

TEST_F(Scenes, RefusesWhatCannotBeEncoded) {
  GltfBuilder gltf = skinned_strip();
  EXPECT_THAT(refusal(gltf, {"", {}, "0"}).what(), HasSubstr("--fps 0: write frames per second"));
  const std::string scene = folder_.write("scene.gltf", gltf.text());
  const auto expect = [&](SourceSpec spec, ExitStatus status, const std::string& part) {
    const ToolError error = thrown_by([&] { open_source(spec); });
    EXPECT_EQ(error.status(), status) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(part));
  };
  expect({{folder_.path("none.dae")}}, ExitStatus::kIo, "No such file");
  expect({{scene, "a.pc2"}}, ExitStatus::kUsage, "it is the only input");
  expect({{scene}, FrameRange{0, 31}}, ExitStatus::kUsage, "has the frames 0-30");
  expect({{scene}, {}, {}, "a.bvh"}, ExitStatus::kUsage, "brings its own skeleton");
  expect({{folder_.write("a.fbx", "x")}}, ExitStatus::kInvalidInput, "a.fbx: it cannot be read");
  expect({{folder_.write("a.x", "")}}, ExitStatus::kInvalidInput, "a.x: ");
  expect({{folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}, {}, {"walk", {}, ""}},
         ExitStatus::kUsage, "--clip is for scenes");
  GltfBuilder broken = skinned_strip();
  broken.json["nodes"][2]["scale"] = {1e30, 1e30, 1e30};
  const Frames read = read_all(*open(broken).source);
  ASSERT_FALSE(read.error);
  broken.animate(0, 1, "scale", {0, 1}, "VEC3", {1, 1, 1, 1e30F, 1e30F, 1e30F});
  const std::optional<Error> error = read_all(*open(broken).source).error;
  ASSERT_TRUE(error);
  EXPECT_THAT(error->message, AllOf(HasSubstr("scene.gltf: in frame "), HasSubstr("NaN or infinite")));
}

TEST_F(Scenes, ReadsMd5WithTheClipBesideIt) {
  // assimp 5.2 passes over a line of the header that follows another one without an empty line between.
  const std::string mesh =
      "MD5Version 10\ncommandline \"\"\n\nnumJoints 2\n\nnumMeshes 1\n\njoints {\n"
      "\"origin\" -1 ( 0 0 0 ) ( 0 0 0 )\n\"arm\" 0 ( 0 0 1 ) ( 0 0 0 )\n}\n\nmesh {\nshader \"skin\"\n"
      "numverts 3\nvert 0 ( 0 0 ) 0 1\nvert 1 ( 1 0 ) 1 1\nvert 2 ( 0 1 ) 2 1\nnumtris 1\ntri 0 0 1 2\n"
      "numweights 3\nweight 0 0 1 ( 0 0 0 )\nweight 1 1 1 ( 1 0 0 )\nweight 2 1 1 ( 0 1 0 )\n}\n";
  std::string motion =
      "MD5Version 10\ncommandline \"\"\n\nnumFrames 3\n\nnumJoints 2\n\nframeRate 30\n\n"
      "numAnimatedComponents 1\n\nhierarchy {\n\"origin\" -1 0 0\n\"arm\" 0 1 0\n}\n\n"
      "bounds {\n( 0 0 0 ) ( 1 1 1 )\n( 0 0 0 ) ( 1 1 1 )\n( 0 0 0 ) ( 1 1 1 )\n}\n\n"
      "baseframe {\n( 0 0 0 ) ( 0 0 0 )\n( 0 0 1 ) ( 0 0 0 )\n}\n\n";
  for (int frame = 0; frame < 3; ++frame) {
    motion.append("frame ").append(std::to_string(frame)).append(" {\n");
    motion.append(std::to_string(2 * frame)).append("\n}\n\n");
  }
  folder_.write("a.md5anim", motion);
  const OpenedSource opened = open_source({{folder_.write("a.md5mesh", mesh)}});
  EXPECT_THAT(opened.source->skeleton().joint_names, ElementsAre("origin", "arm"));
  const Frames read = read_all(*opened.source);
  ASSERT_EQ(read.frames.size(), 3U);
  // assimp turns the format's up axis, z, to y; the arm slides by two along x each frame.
  for (std::size_t frame = 0; frame < 3; ++frame) {
    const float way = 2 * static_cast<float>(frame);
    expect_vertex(read.frames[frame], 0, 0, 0, 0);
    expect_vertex(read.frames[frame], 1, 1 + way, 1, 0);
    expect_vertex(read.frames[frame], 2, way, 1, -1);
  }
}

TEST_F(Scenes, RefusesVertexAnimationThatWouldStandStill) {
  ByteString md3(false);
  md3.text("IDP3")
      .add(std::int32_t{15})
      .text(std::string(68, '\0'))
      .add(std::int32_t{3})
      .add(std::int32_t{0});
  const std::string path = folder_.write("a.md3", md3.bytes());
  const ToolError error = thrown_by([&] { open_source({{path}}); });
  EXPECT_EQ(error.status(), ExitStatus::kInvalidInput);
  EXPECT_THAT(error.what(), HasSubstr("a.md3: it holds a mesh for each of 3 frames"));
}

TEST_F(Scenes, RefusesAClipThatLastsForever) {
  GltfBuilder gltf = two_triangles();
  gltf.animate(0, 1, "scale", {0, 1e12F}, "VEC3", {1, 1, 1, 1, 1, 1});
  EXPECT_THAT(refusal(gltf, {}).what(), HasSubstr("clip \"walk\" lasts 1e+12 s"));
}

}  // namespace
}  // namespace tvg::cli
