#include "tool_test_fixture.hpp"

#include <vector>

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

class MeasureTest : public ToolTest {
 protected:
  MeasureTest() {
    corpus::write_skeleton(folder_.path("hand.skeleton.json"), corpus::make_hand({400, kFrames}).joints);
  }

  /// Encodes with these options, verifies, and gives the stream.
  std::string stream_with(const std::string& options) const {
    good("tvg encode hand.obj hand.pc2 -o m.tvg --bits 13:11 --gop 5 -q " + options +
         " && tvg verify m.tvg -q");
    return folder_.read("m.tvg");
  }
};

TEST_F(MeasureTest, MarksByEveryCriterion) {
  const std::string curv = stream_with("");
  EXPECT_EQ(stream_with("--measure curv"), curv);
  EXPECT_EQ(stream_with("--measure 2*curv"), curv) << "one weight alone changes no rank";
  std::string weights;
  for (std::uint32_t v = 0; v < hand_.mesh.vertex_count; ++v) weights += std::to_string(v % 7) + "\n";
  folder_.write("w.txt", weights);
  const std::vector<std::string> options = {
      "--measure skel --skeleton hand.skeleton.json",
      "--measure skel --skeleton hand.skeleton.json --skel-region weights",
      "--measure skel --skeleton hand.skeleton.json --skel-threshold 0.4",
      "--measure curv+skel --skeleton hand.skeleton.json",
      "--measure curv-0.01*skel --skeleton hand.skeleton.json --skel-alpha 0.9",
      "--measure curv+3*velocity --alpha 1",
      "--measure curvature-norm --alpha 0.25",
      "--measure=-distance --viewpoint 0,5,-30",
      "--measure weights --weights w.txt",
      "--measure velocity --important 20%",
      "--measure velocity --important-above 0.001",
      "--smooth 2",
      "--lookahead 0"};
  std::vector<std::string> streams = {curv};
  for (const std::string& option : options) {
    streams.push_back(stream_with(option));
    EXPECT_EQ(std::count(streams.begin(), streams.end(), streams.back()), 1) << option;
  }
  EXPECT_EQ(stream_with("--lookahead gop"), curv);
}

TEST_F(MeasureTest, TakesTheJointsOfTheFramesThatAreEncoded) {
  const std::string skel = "--measure curv+skel --skeleton hand.skeleton.json --gop 3 --bits 13:11 -q";
  good("tvg encode hand.obj hand.pc2 -o part.tvg --frames 4-9 " + skel);
  EXPECT_EQ(json("tvg info part.tvg --json")["frames"], 6);
  expect_failure("cat hand.pc2 | tvg encode hand.obj - -o x.tvg --measure skel --bits 13:11", 1,
                 "--skeleton");
  good("cat hand.pc2 | tvg encode hand.obj - -o x.tvg " + skel);
}

TEST_F(MeasureTest, RefusesMeasuresThatCannotBe) {
  const std::string encode = "tvg encode hand.obj hand.pc2 -o x.tvg --bits 13:11 ";
  for (const std::string measure : {"foo", "curv+", "''", "curv,skel", "2curv", "2*", "curv++skel", "curv*2",
                                    "curvskel", "nan*curv", "1e999*curv"}) {
    expect_failure(encode + "--measure " + measure, 1, "velocity, distance, weights");
  }
  expect_failure(encode + "--measure skel", 1, "hand.obj, hand.pc2 has no skeleton");
  expect_failure(encode + "--measure distance", 1, "--viewpoint 0,1.5,-4");
  expect_failure(encode + "--measure distance --viewpoint 1,2", 1, "0,1.5,-4");
  expect_failure(encode + "--measure distance --viewpoint 1,2,inf", 1, "0,1.5,-4");
  expect_failure(encode + "--measure weights", 1, "--weights");
  expect_failure(encode + "--viewpoint 1,2,3", 1, "--viewpoint is for the criterion distance");
  expect_failure(encode + "--measure velocity --alpha 0.5", 1, "--alpha is for the criterion curv");
  expect_failure(encode + "--skel-threshold 1", 1, "--skel-threshold is for the criterion skel");
  expect_failure(encode + "--lookahead 3", 1, "--lookahead");
  expect_failure("tvg encode hand.obj hand.pc2 -o x.tvg --measure velocity", 1, "need two resolutions");
}

TEST_F(MeasureTest, RefusesFilesThatDoNotFit) {
  const std::string encode = "tvg encode hand.obj hand.pc2 -o x.tvg --bits 13:11 ";
  folder_.write("few.txt", "1\n2\n");
  expect_failure(encode + "--measure weights --weights few.txt", 1, "2 numbers for the mesh's 394 vertices");
  folder_.write("bad.txt", "1\nx\n");
  expect_failure(encode + "--measure weights --weights bad.txt", 3, "bad.txt, line 2");
  expect_failure(encode + "--measure weights --weights absent.txt", 2, "absent.txt");
  folder_.write("bad.json", "{}");
  expect_failure(encode + "--measure skel --skeleton bad.json", 3, "bad.json");
  corpus::write_skeleton(folder_.path("short.json"), corpus::make_hand({400, 3}).joints);
  expect_failure(encode + "--measure skel --skeleton short.json", 3, "short.json has 3 frames");
  JointTracks bare = corpus::make_hand({400, kFrames}).joints;
  bare.skeleton.heaviest_joint.clear();
  corpus::write_skeleton(folder_.path("bare.json"), bare);
  good(encode + "--measure skel --skeleton bare.json");
  expect_failure(encode + "--measure skel --skeleton bare.json --skel-region weights", 1, "no skin weights");
}

TEST_F(MeasureTest, CompareReportsSted) {
  stream_with("");
  const auto figures = json("tvg compare hand.pc2 m.tvg --mesh hand.obj --json");
  EXPECT_GT(figures["sted"], 0);
  EXPECT_GT(figures["sted_temporal"], 0);
  EXPECT_GE(figures["sted"], figures["sted_spatial"]);
  EXPECT_THAT(good("tvg compare hand.pc2 m.tvg --mesh hand.obj").out, HasSubstr("STED"));
}

}  // namespace
}  // namespace tvg::cli::testing
