#include "tool_test_fixture.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

// Coarser meshes of a stream, as the tool shows, decodes and draws them.
namespace tvg::cli::testing {
namespace {

class LodTest : public ToolTest {
 protected:
  LodTest() {
    std::filesystem::copy_file(std::string(TVG_PROJECT) + "/corpus/conformance/lods_basis.tvg",
                               folder_.path("lods.tvg"));
  }
};

TEST_F(LodTest, InfoListsLevelsAndLodsAndTheirBytes) {
  const nlohmann::json info = json("tvg info lods.tvg --json");
  EXPECT_EQ(info["levels"], 6);
  ASSERT_EQ(info["lods"].size(), 2u);
  EXPECT_EQ(info["lods"][0]["vertices"], 49);
  EXPECT_EQ(info["lods"][1]["vertices"], 22);
  EXPECT_GT(info["bytes_by_purpose"]["levels"], 0);
  EXPECT_GT(info["bytes_by_purpose"]["lods"], info["lods"][0]["bytes"]);
  ASSERT_EQ(info["planes"].size(), 6u);
  EXPECT_EQ(info["planes"][4]["part"], 1);
  const std::string text = good("tvg info lods.tvg").out;
  EXPECT_NE(text.find("6 levels of vertices"), std::string::npos) << text;
}

TEST_F(LodTest, DecodeRestoresACoarserMeshAndSaysWhatItRead) {
  const Outcome coarse = good("tvg decode lods.tvg -o coarse_%d.obj --lod 2");
  EXPECT_NE(coarse.err.find("lod 2 of 2: 22 vertices"), std::string::npos) << coarse.err;
  std::ifstream file(folder_.path("coarse_0.obj"));
  std::size_t vertices = 0;
  for (std::string line; std::getline(file, line);) vertices += line.starts_with("v ") ? 1 : 0;
  EXPECT_EQ(vertices, 22u);
  good("tvg encode hand.obj hand.pc2 -o hand.tvg -q");
  EXPECT_NE(good("tvg decode hand.tvg -o back.pc2 --lod 1").err.find("no coarser mesh"), std::string::npos);
}

TEST_F(LodTest, MoreThan16IsNoLod) {
  expect_failure("tvg decode lods.tvg -o back.pc2 --lod 17", 1, "--lod");
}

#ifdef TVG_HAS_PLAYER
TEST_F(LodTest, RenderDrawsACoarserMesh) {
  EXPECT_NE(good("tvg render lods.tvg -o a.png --frames 1 --size 64x64 --lod 1").err.find("49 vertices"),
            std::string::npos);
}
#endif

}  // namespace
}  // namespace tvg::cli::testing
