#include "tests/importers/gltf_builder.hpp"
#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

/// A tetrahedron that slides along x in clip "slide" and along y in clip "rise", each within a second.
std::string sliding_scene() {
  GltfBuilder gltf;
  const nlohmann::json primitive =
      gltf.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  gltf.json["meshes"] = {{{"name", "Block"}, {"primitives", {primitive}}}};
  gltf.json["nodes"] = {{{"name", "BlockNode"}, {"mesh", 0}}};
  gltf.animate(0, 0, "translation", {0, 1}, "VEC3", {0, 0, 0, 4, 0, 0});
  gltf.animate(1, 0, "translation", {0, 1}, "VEC3", {0, 0, 0, 0, 4, 0});
  gltf.json["animations"][0]["name"] = "slide";
  gltf.json["animations"][1]["name"] = "rise";
  set_roots(gltf, {0});
  return gltf.text();
}

TEST_F(ToolTest, EncodesAndComparesAScene) {
  folder_.write("block.gltf", sliding_scene());
  const Outcome encoded = good("tvg encode block.gltf -o block.tvg --fps 10 --bits 14");
  EXPECT_THAT(encoded.err, HasSubstr("--clip picks another: \"rise\""));
  const auto info = json("tvg info block.tvg --json");
  EXPECT_EQ(info["frames"], 11);
  EXPECT_EQ(info["metadata"]["fps"], "10");
  EXPECT_EQ(info["metadata"]["name"], "slide");
  EXPECT_EQ(info["metadata"]["up"], "y");
  const auto same = json("tvg compare block.gltf block.tvg --json");
  EXPECT_EQ(same["frames"], 11);
  EXPECT_LT(same["relative_max_coordinate_error"], 1e-4);
  good("tvg encode block.gltf -o rise.tvg --clip rise --mesh Block --frames 5-20");
  EXPECT_EQ(json("tvg info rise.tvg --json")["frames"], 16);
  EXPECT_GT(json("tvg compare block.gltf block.tvg --clip rise --json")["relative_max_coordinate_error"],
            0.1);
  expect_failure("tvg encode block.gltf -o x.tvg --clip fall", 1, "it has 0 \"slide\", 1 \"rise\"");
  expect_failure("tvg encode hand.obj hand.pc2 -o x.tvg --clip fall", 1, "--clip is for scenes");
}

TEST_F(ToolTest, InfoListsWhatASceneHolds) {
  folder_.write("block.gltf", sliding_scene());
  EXPECT_THAT(good("tvg info block.gltf").out, HasSubstr("a scene of 2 clips, 1 meshes and 0 joints"));
  const auto info = json("tvg info block.gltf --json --fps 25");
  EXPECT_EQ(info["clips"][1]["name"], "rise");
  EXPECT_EQ(info["clips"][1]["frames"], 26);
  EXPECT_EQ(info["meshes"][0]["name"], "Block");
  EXPECT_EQ(info["meshes"][0]["faces"], 4);
  expect_failure("tvg info none.gltf", 2, "none.gltf");
}

}  // namespace
}  // namespace tvg::cli::testing
