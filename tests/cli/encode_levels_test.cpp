#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

/// A user who keeps levels of an animation in its stream.
class EncodeLevels : public ToolTest {};

TEST_F(EncodeLevels, FromSimplifyingMakeAStreamOfTheSameFrames) {
  for (const std::string mode : {"--predictor pyramid", "--mode basis", "--lossless"}) {
    good("tvg encode hand.obj hand.pc2 -o l.tvg -q --levels simplify " + mode + " && tvg verify l.tvg -q");
    EXPECT_LT(json("tvg compare hand.pc2 l.tvg --mesh hand.obj --json")["relative_rms_coordinate_error"],
              1e-3);
  }
}

TEST_F(EncodeLevels, CoarserMeshesHaveAsManyVerticesAsAskedFor) {
  good("tvg encode hand.obj hand.pc2 -o l.tvg -q --lod 2 --lod-ratio 3 && tvg verify l.tvg -q");
  good("tvg decode l.tvg --lod 2 -o lod.pc2 -q");
  const nlohmann::json coarse = json("tvg compare lod.pc2 lod.pc2 --mesh lod.obj --json");
  EXPECT_EQ(coarse["vertices"], hand_.mesh.vertex_count / 9);
}

TEST_F(EncodeLevels, SayWhatWouldBeRight) {
  const std::string encode = "tvg encode hand.obj hand.pc2 -o l.tvg ";
  expect_failure(encode + "--lod-ratio 2", 1, "--lod 3");
  expect_failure(encode + "--lod 9", 1, "enough for 2 coarser meshes");
  expect_failure(encode + "--lod 2 --lod-ratio 1", 1, "--lod-ratio 1");
  expect_failure(encode + "--lod 2 --live", 1, "not with --live");
  expect_failure("cat hand.pc2 | tvg encode hand.obj - -o l.tvg --lod 2", 1, "write it to a file first");
}

}  // namespace
}  // namespace tvg::cli::testing
