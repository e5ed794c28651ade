#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

/// Frames of two meshes by turns, one of them with its faces in another order, and one that shows nothing.
class ChangesTest : public ToolTest {
 protected:
  ChangesTest() {
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\n";
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0.25\nf 1 2 3\n";
    const std::vector<std::string> files = {square + "f 1 2 3\nf 1 3 4\n", square + "f 1 2 3\nf 1 3 4\n",
                                            triangle, "# nothing\n", square + "f 3 4 1\nf 2 3 1\n"};
    for (std::size_t i = 0; i < files.size(); ++i)
      folder_.write("s/f" + std::to_string(i) + ".obj", files[i]);
    for (int i = 1; i < 5; ++i) {
      std::string fan = "v 0 0 0\nv 1 0 0\n";
      for (int k = 1; k <= i; ++k) fan += "v " + std::to_string(k) + " 1 0.5\n";
      for (int k = 1; k <= i; ++k) fan += "f 1 " + std::to_string(k + 1) + " " + std::to_string(k + 2) + "\n";
      folder_.write("c/f" + std::to_string(i) + ".obj", fan);
    }
  }
};

TEST_F(ChangesTest, AreFollowedFromFilesToFiles) {
  const Outcome made = run("tvg encode s -o s.tvg");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("5 frames of 3 meshes"));
  EXPECT_THAT(made.err, HasSubstr("the frame shows nothing"));
  good("tvg verify s.tvg");
  EXPECT_EQ(chunks("s.tvg", "MESH").size(), 3U);
  const auto info = json("tvg info s.tvg --json");
  EXPECT_EQ(info["stretches"].size(), 4U);
  EXPECT_EQ(info["stretches"][2]["faces"], 0);
  EXPECT_LE(json("tvg compare s s.tvg --json")["max_coordinate_error"], 0.00025);
  good("mkdir b && tvg decode s.tvg -o b/%d.ply && tvg compare b s.tvg -q");
  EXPECT_EQ(json("tvg compare b s.tvg --json")["max_coordinate_error"], 0);
  expect_failure("tvg decode s.tvg -o s.pc2", 1, "back_%04d.ply");
  good("tvg join s.tvg s.tvg -o twice.tvg && tvg verify twice.tvg");
  EXPECT_EQ(json("tvg info twice.tvg --json")["frames"], 10);
}

TEST_F(ChangesTest, OfCapturedVolumesGiveUpTheVertexOrder) {
  EXPECT_THAT(run("tvg encode c -o c.tvg").err, HasSubstr("--keep-order keeps it"));
  EXPECT_EQ(json("tvg info c.tvg --json")["keeps_vertex_order"], false);
  EXPECT_LE(json("tvg compare c c.tvg --json")["hausdorff"], 0.005);
  good("tvg encode c -o kept.tvg --keep-order");
  EXPECT_LE(json("tvg compare c kept.tvg --json")["max_coordinate_error"], 0.002);
}

TEST_F(ChangesTest, AreRefusedWithAWayOutWhereOneMeshMustHold) {
  expect_failure("tvg simplify s --vertices 3 -o no.tvg", 3, "`--frames 0-1` takes those of the one before");
  expect_failure("tvg measure s", 3, "`--frames 0-1` takes those of the one before");
  expect_failure("tvg encode s -o no.tvg --gaps refuse", 3, "(frame 3)");
  good("tvg encode s -o held.tvg --gaps hold && tvg compare s held.tvg --gaps hold");
}

}  // namespace
}  // namespace tvg::cli::testing
