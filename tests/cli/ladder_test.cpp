#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

class LadderTest : public ToolTest {
 protected:
  LadderTest() {
    const Sequence cloth = corpus::find_corpus_entry("cloth")->make({1500, 40}).sequence;
    corpus::write_obj(folder_.path("cloth.obj"), cloth);
    corpus::write_pc2(folder_.path("cloth.pc2"), cloth);
  }

  nlohmann::json ladder(const std::string& folder) const {
    return nlohmann::json::parse(folder_.read(folder + "/ladder.json"), nullptr, false);
  }

  /// First frames of the GOPs of a stream, and of its periods.
  std::pair<std::vector<int>, std::vector<int>> borders(const std::string& stream) const {
    const nlohmann::json info = json("tvg info --json " + stream);
    std::pair<std::vector<int>, std::vector<int>> borders;
    for (const nlohmann::json& gop : info["gops"]) borders.first.push_back(gop["first_frame"]);
    if (info.contains("planes")) {
      for (const nlohmann::json& plan : info["planes"]) borders.second.push_back(plan["first_frame"]);
    }
    return borders;
  }

  void expect_agrees(const std::string& folder) const {
    const nlohmann::json all = ladder(folder);
    ASSERT_FALSE(all.is_discarded());
    EXPECT_EQ(all["tvg_ladder"], 1);
    std::uint64_t bytes = UINT64_MAX;
    for (const nlohmann::json& stream : all["streams"]) {
      const std::string path = folder + "/" + stream["file"].get<std::string>();
      const nlohmann::json info = json("tvg info --json " + path);
      EXPECT_EQ(info["frames"], all["frame_count"]) << path;
      EXPECT_EQ(stream["bytes"], std::filesystem::file_size(folder_.path(path))) << path;
      EXPECT_EQ(info["stretches"][0]["vertices"], stream["vertices"]) << path;
      EXPECT_EQ(borders(path), borders(folder + "/" + all["streams"][0]["file"].get<std::string>())) << path;
      EXPECT_NEAR(stream["bits_per_second"].get<double>(),
                  8 * stream["bytes"].get<double>() * all["frame_rate"].get<double>() /
                      all["frame_count"].get<double>(),
                  1)
          << path;
      EXPECT_LT(stream["bytes"].get<std::uint64_t>(), bytes) << path;
      EXPECT_GT(stream["largest_error"].get<double>(), 0) << path;
      bytes = stream["bytes"];
      good("tvg verify -q " + path);
    }
  }
};

TEST_F(LadderTest, ItsManifestAgreesWithItsStreams) {
  good("tvg ladder cloth.obj cloth.pc2 --period 16 --gop 8 --fps 24 -o steps");
  expect_agrees("steps");
  const nlohmann::json all = ladder("steps");
  EXPECT_EQ(all["frame_rate"], 24);
  EXPECT_EQ(all["frame_count"], 40);
  EXPECT_EQ(all["period_frames"], 16);
  ASSERT_EQ(all["streams"].size(), 3U);
  EXPECT_EQ(all["streams"][0]["file"], "high.tvg");
  EXPECT_EQ(all["streams"][0]["bits"], nlohmann::json({11, 11}));
  EXPECT_EQ(all["streams"][1]["bits"], nlohmann::json({9, 9}));
  EXPECT_EQ(all["streams"][1]["vertices"], all["streams"][0]["vertices"]);
  EXPECT_LT(4 * all["streams"][2]["vertices"].get<int>(), all["streams"][0]["vertices"].get<int>() + 8);
  EXPECT_EQ(borders("steps/low.tvg").second, (std::vector<int>{0, 16, 32}));
}

TEST_F(LadderTest, EveryModeAndResolutionHasSteps) {
  for (const char* options : {"--mode elp --gop 10", "--mode elp --bits 13:11 --gop 10",
                              "--mode elp --step 0.001", "--max-error 0.1%", "--steps 2"}) {
    good(std::string("rm -rf steps; tvg ladder cloth.obj cloth.pc2 -q -o steps ") + options);
    expect_agrees("steps");
  }
  EXPECT_EQ(good("ls steps").out, "high.tvg\nladder.json\nlow.tvg\n");
}

TEST_F(LadderTest, NoStepLosesWhatTheMeshHas) {
  good("tvg encode cloth.obj cloth.pc2 -o cloth.tvg -q && tvg decode cloth.tvg --frames 0-9 -o in_%04d.obj");
  // Texture coordinates of corners, which no mesh of fewer vertices has.
  good(
      "for f in in_*.obj; do { grep -v '^f' $f; echo vt 0 0; echo vt 1 0; echo vt 0 1; "
      "grep '^f' $f | awk '{print \"f\", $2\"/1\", $3\"/2\", $4\"/3\"}'; } >out && mv out "
      "$f; done");
  EXPECT_THAT(good("tvg ladder in_%04d.obj -o steps").err,
              HasSubstr("note: low.tvg has all vertices of the mesh"));
  const nlohmann::json all = ladder("steps");
  for (const nlohmann::json& stream : all["streams"]) {
    const std::string path = "steps/" + stream["file"].get<std::string>();
    EXPECT_EQ(stream["vertices"], all["streams"][0]["vertices"]) << path;
    EXPECT_EQ(json("tvg info --json " + path)["attributes"].size(), 1U) << path;
  }
}

TEST_F(LadderTest, OfAMeshThatChangesHasThePeriodsOfTheChanges) {
  good(
      "tvg encode cloth.obj cloth.pc2 --frames 0-9 -q -o a.tvg && tvg encode hand.obj hand.pc2 -q -o b.tvg "
      "&& "
      "tvg join a.tvg b.tvg -q -o ab.tvg && tvg ladder ab.tvg -q -o steps");
  expect_agrees("steps");
  EXPECT_EQ(ladder("steps")["frame_count"], 22);
  good("rm -r steps && tvg ladder ab.tvg --period 4 --gop 2 -q -o steps");
  expect_agrees("steps");
  EXPECT_EQ(borders("steps/low.tvg").second, (std::vector<int>{0, 4, 8, 10, 14, 18}));
}

TEST_F(LadderTest, WhatHasNoStepsIsRefusedAndLeavesNothing) {
  expect_failure("tvg ladder cloth.obj cloth.pc2 --lossless -o steps", 1, "--lossless");
  expect_failure("cat cloth.pc2 | tvg ladder cloth.obj - -o steps", 1, "read only once");
  expect_failure("tvg ladder gone.obj -o steps", 2, "gone.obj");
  good("head -c 300000 cloth.pc2 >cut.pc2");
  expect_failure("tvg ladder cloth.obj cut.pc2 -o steps", 3, "cut.pc2");
  good("test ! -e steps");
  expect_failure("tvg ladder cloth.obj cloth.pc2 -o -", 1, "no folder");
  good("tvg encode cloth.obj cloth.pc2 -q -o high.tvg");
  expect_failure("tvg ladder high.tvg -o .", 1, "high.tvg");
}

}  // namespace
}  // namespace tvg::cli::testing
