#include "tool_test_fixture.hpp"

#include <cmath>

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

TEST_F(ToolTest, EncodesAndDecodesEveryFormat) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --gop 5");
  for (const std::string name : {"back.pc2", "back.mdd"}) {
    good("tvg decode hand.tvg -o " + name);
    const auto figures = json("tvg compare hand.pc2 " + name + " --mesh hand.obj --json");
    EXPECT_EQ(figures["frames"], kFrames);
    EXPECT_LT(figures["relative_max_coordinate_error"], 1.0 / 2048);
    good("tvg encode hand.obj " + name + " -o again.tvg");
  }
  for (const std::string suffix : {"obj", "ply", "off"}) {
    good("mkdir " + suffix + " && tvg decode hand.tvg -o " + suffix + "/f_%04d." + suffix);
    good("tvg encode " + suffix + " -o again.tvg");
    EXPECT_LT(json("tvg compare hand.tvg " + suffix + "/f_####." + suffix +
                   " --json")["relative_max_coordinate_error"],
              1e-5)
        << suffix;
  }
  good("mkdir stl && tvg decode hand.tvg -o stl/f_%04d.stl && tvg encode stl/f_%04d.stl -o again.tvg");
  EXPECT_EQ(json("tvg info again.tvg --json")["frames"], kFrames);
}

TEST_F(ToolTest, StreamsThroughPipes) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg && tvg decode hand.tvg -o back.pc2");
  good("set -o pipefail; tvg encode hand.obj hand.pc2 -o - | tvg decode - -o x.pc2");
  EXPECT_EQ(folder_.read("x.pc2"), folder_.read("back.pc2"));
  good("tvg encode hand.obj hand.pc2 -o - | tvg join - -o - | cmp - hand.tvg");
  good("cat hand.tvg | tvg info - && cat hand.tvg | tvg verify -");
  good("tvg decode hand.tvg -o - | cmp - back.pc2");
  const Outcome once = good("cat hand.pc2 | tvg encode hand.obj - -o once.tvg");
  EXPECT_THAT(once.err, HasSubstr("each GOP has a bounding box of its own"));
  good("tvg verify once.tvg");
}

TEST_F(ToolTest, InfoDocumentsTheStreamAsJson) {
  good(
      "tvg encode hand.obj hand.pc2 -o hand.tvg --gop 5 --bits 13:11 --fps 30 --name wave --meta maker=test");
  const auto info = json("tvg info hand.tvg --json");
  EXPECT_EQ(info["frames"], kFrames);
  EXPECT_EQ(info["vertices"], hand_.mesh.vertex_count);
  EXPECT_EQ(info["faces"], hand_.mesh.faces.size());
  EXPECT_EQ(info["metadata"]["fps"], "30");
  EXPECT_EQ(info["metadata"]["name"], "wave");
  EXPECT_EQ(info["metadata"]["maker"], "test");
  EXPECT_EQ(info["bytes"], folder_.read("hand.tvg").size());
  EXPECT_EQ(info["keeps_vertex_order"], true);
  EXPECT_EQ(info["limits"]["vertices"], hand_.mesh.vertex_count);
  ASSERT_EQ(info["gops"].size(), 3U);
  EXPECT_EQ(info["gops"][2]["first_frame"], 10);
  EXPECT_EQ(info["gops"][2]["frame_count"], 2);
  EXPECT_EQ(info["gops"][0]["fine_bits"], 13);
  EXPECT_EQ(info["gops"][0]["coarse_bits"], 11);
  const auto decoded = json("tvg info hand.tvg --json --bits");
  EXPECT_FALSE(info["bytes_by_purpose"].contains("residuals_x"));
  EXPECT_GT(decoded["bytes_by_purpose"]["residuals_x"], 0);
  EXPECT_GT(decoded["gops"][0]["flagged"], 0);
  for (const auto& purposes : {info["bytes_by_purpose"], decoded["bytes_by_purpose"]}) {
    double sum = 0;
    for (const auto& [purpose, bytes] : purposes.items()) sum += bytes.get<double>();
    EXPECT_NEAR(sum, info["bytes"].get<double>(), 0.01);
  }
  std::uint64_t chunk_bytes = 8;
  for (const auto& chunk : info["chunks"]) chunk_bytes += chunk["bytes"].get<std::uint64_t>();
  EXPECT_EQ(chunk_bytes, info["bytes"]);
}

TEST_F(ToolTest, VerifyFindsDamageAndSaysWhatIsLost) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --gop 5");
  EXPECT_EQ(json("tvg verify hand.tvg --json")["valid"], true);
  const auto gop = chunks("hand.tvg", "GOP ").at(1);
  flip_byte("hand.tvg", gop.first + gop.second / 2);
  const auto report = json("tvg verify hand.tvg --json");
  EXPECT_EQ(report["valid"], false);
  EXPECT_EQ(report["frames"].get<int>() + report["frames_lost"].get<int>(), static_cast<int>(kFrames));
  EXPECT_EQ(report["findings"][0]["name"], "checksum-mismatch");
  expect_failure("tvg verify hand.tvg", 3, "1 finding");
}

TEST_F(ToolTest, DamageStopsDecodingUnlessConcealed) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --gop 5");
  const auto gop = chunks("hand.tvg", "GOP ").at(1);
  flip_byte("hand.tvg", gop.first + gop.second / 2);
  expect_failure("tvg decode hand.tvg -o back.pc2", 3, "hand.tvg: frame");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("back.pc2")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("back.obj")));
  const Outcome concealed = good("tvg decode hand.tvg -o back.pc2 --conceal");
  EXPECT_THAT(concealed.err, HasSubstr("lost"));
  EXPECT_EQ(folder_.read("back.pc2").size(), folder_.read("hand.pc2").size());
  good("tvg decode hand.tvg -o part.pc2 --frames 0-4");  // what is not damaged can be had
}

TEST_F(ToolTest, FramesPicksTheSameFrames) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --gop 4 && tvg decode hand.tvg -o back.pc2");
  good("tvg decode hand.tvg -o part.pc2 --frames 6-9");
  const std::size_t frame = 12 * std::size_t{hand_.mesh.vertex_count};
  EXPECT_EQ(folder_.read("part.pc2").substr(32), folder_.read("back.pc2").substr(32 + 6 * frame, 4 * frame));
  good("cat hand.tvg | tvg decode - -o - --frames 6-9 | cmp - part.pc2");
  good("tvg encode hand.obj hand.pc2 -o part.tvg --frames 6-9 --step 0.001");
  EXPECT_EQ(json("tvg info part.tvg --json")["frames"], 4);
  expect_failure("tvg decode hand.tvg -o no.pc2 --frames 6-12", 1, "has the frames 0-11");
  expect_failure("tvg encode hand.obj hand.pc2 -o no.tvg --frames 12-13", 1, "has the frames 0-11");
  expect_failure("cat hand.tvg | tvg decode - -o no_%d.obj --frames 6-12", 1, "ends at frame 11");
}

TEST_F(ToolTest, HybridErrorIsWithinHalfAStepOfEachLattice) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --bits 13:9 --important 30%");
  const auto gop = json("tvg info hand.tvg --json --bits")["gops"][0];
  const double step = gop["step"];
  const double share = gop["flagged"].get<double>() / hand_.mesh.vertex_count;
  EXPECT_NEAR(share, 0.3, 0.01);
  const auto figures = json("tvg compare hand.pc2 hand.tvg --mesh hand.obj --json");
  EXPECT_LE(figures["max_coordinate_error"], 8 * step * 1.001);
  EXPECT_GT(figures["max_coordinate_error"], 0.5 * step);  // the coarse lattice is in use
}

TEST_F(ToolTest, StepBoundsTheErrorInUnitsOfTheMesh) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --step 0.002");
  EXPECT_LE(json("tvg compare hand.pc2 hand.tvg --mesh hand.obj --json")["max_coordinate_error"],
            0.001 * 1.001);
}

TEST_F(ToolTest, LosslessGivesTheCacheBackByteForByteAndLeavesNothingToChoose) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --lossless --gop 5");
  good("tvg decode hand.tvg -o back.pc2 && cmp hand.pc2 back.pc2 && tvg verify -q hand.tvg");
  const auto info = json("tvg info hand.tvg --json --bits");
  EXPECT_EQ(info["gops"][0]["mode"], "lossless");
  EXPECT_EQ(info["gops"][0]["fine_bits"], 32);
  EXPECT_EQ(info["damages"], 0);
  EXPECT_GT(info["bytes_by_purpose"]["residuals_x"], 0);
  EXPECT_NE(good("tvg info hand.tvg").out.find(" lossless"), std::string::npos);
  for (const char* const option :
       {"--bits 12", "--step 0.1", "--predictor auto", "--mode elp", "--important 20%", "--measure curv"}) {
    expect_failure(std::string("tvg encode hand.obj hand.pc2 -o no.tvg --lossless ") + option, 1,
                   "--lossless");
  }
}

TEST_F(ToolTest, ReorderIsSmallerAndSaysSo) {
  good("tvg encode hand.obj hand.pc2 -o kept.tvg && tvg encode hand.obj hand.pc2 -o free.tvg --reorder");
  EXPECT_LT(folder_.read("free.tvg").size(), folder_.read("kept.tvg").size());
  EXPECT_EQ(json("tvg info free.tvg --json")["keeps_vertex_order"], false);
  EXPECT_EQ(json("tvg info free.tvg --json")["bytes_by_purpose"]["order"], 0.0);
}

TEST_F(ToolTest, ThreadsDoNotChangeTheBytes) {
  good(
      "tvg encode hand.obj hand.pc2 -o a.tvg --gop 3 --threads 1 && tvg encode hand.obj hand.pc2 -o b.tvg "
      "--gop 3 "
      "--threads 4 && cmp a.tvg b.tvg");
}

TEST_F(ToolTest, QuietPrintsNothing) {
  for (const std::string command :
       {"tvg encode hand.obj hand.pc2 -o hand.tvg --quiet", "tvg decode hand.tvg -o back.pc2 --quiet",
        "tvg verify hand.tvg --quiet", "tvg join hand.tvg hand.tvg -o two.tvg --quiet"}) {
    const Outcome quiet = good(command);
    EXPECT_EQ(quiet.out + quiet.err, "") << command;
  }
}

TEST_F(ToolTest, HelpAndVersionSucceed) {
  EXPECT_THAT(good("tvg --help").out, HasSubstr("Exit status"));
  EXPECT_THAT(good("tvg --version").out, HasSubstr("."));
  for (const std::string command : {"encode", "decode", "info", "verify", "compare", "join"}) {
    EXPECT_THAT(good("tvg " + command + " --help").out, HasSubstr("Usage")) << command;
  }
}

}  // namespace
}  // namespace tvg::cli::testing
