#include "tool_test_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <map>

// Mode basis and --max-error as a user types them.
namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

class BasisTest : public ToolTest {
 protected:
  static constexpr const char* kEncode = "tvg encode hand.obj hand.pc2 -o no.tvg ";

  void expect_usage_error(const std::string& options, const std::string& words) const {
    expect_failure(kEncode + options, 1, words);
    EXPECT_FALSE(std::filesystem::exists(folder_.path("no.tvg"))) << options;
  }
  double largest_error(const std::string& stream) const {
    return json("tvg compare hand.pc2 " + stream + " --mesh hand.obj --json")["max_coordinate_error"];
  }
  double rms_error(const std::string& stream) const {
    return json("tvg compare hand.pc2 " + stream + " --mesh hand.obj --json")["rms_coordinate_error"];
  }
};

TEST_F(BasisTest, InfoTellsOfPlanesTheirFramesAndWhatTheyTake) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --mode basis --period 8 --gop 4");
  good("tvg verify -q hand.tvg");
  const auto info = json("tvg info hand.tvg --json --bits");
  ASSERT_EQ(info["planes"].size(), 2U);
  EXPECT_EQ(info["planes"][0]["first_frame"], 0);
  EXPECT_EQ(info["planes"][0]["frame_count"], 8);
  EXPECT_EQ(info["planes"][1]["first_frame"], 8);
  EXPECT_EQ(info["planes"][1]["frame_count"], 4);
  ASSERT_EQ(info["gops"].size(), 3U);
  for (const auto& gop : info["gops"]) {
    EXPECT_EQ(gop["mode"], "basis");
    EXPECT_EQ(gop["predictors"], nlohmann::json({"rows"}));
    EXPECT_EQ(gop["components"], info["planes"][gop["first_frame"] == 8 ? 1 : 0]["components"]);
    EXPECT_EQ(gop["fine_bits"], 11);
  }
  EXPECT_EQ(info["frames_by_predictor"]["rows"], kFrames);
  EXPECT_EQ(info["frames_by_predictor"]["elp"], 0);
  std::size_t plan_bytes = 0;
  for (const auto& [offset, bytes] : chunks("hand.tvg", "PLAN")) plan_bytes += bytes;
  EXPECT_EQ(info["bytes_by_purpose"]["planes"], static_cast<double>(plan_bytes));
  EXPECT_GT(info["bytes_by_purpose"]["rows"], 0);
  EXPECT_EQ(info["bytes_by_purpose"]["residuals_x"], 0.0);
  double sum = 0;
  for (const auto& [purpose, bytes] : info["bytes_by_purpose"].items()) sum += bytes.get<double>();
  EXPECT_NEAR(sum, info["bytes"].get<double>(), 0.01);
}

TEST_F(BasisTest, InfoPrintsThem) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --mode basis");
  const std::string text = good("tvg info hand.tvg --bits").out;
  for (const char* const words :
       {"rows: 12", "\n  planes ", "\n  rows ", "planes shared by GOPs", " basis ", "components"})
    EXPECT_THAT(text, HasSubstr(words));
  good("tvg encode hand.obj hand.pc2 -o plain.tvg");
  EXPECT_THAT(good("tvg info plain.tvg").out, ::testing::Not(HasSubstr("shared")));
}

TEST_F(BasisTest, APeriodIsANumberOfFramesOrAll) {
  const auto periods = [&](const std::string& options) {
    good("tvg encode hand.obj hand.pc2 -o hand.tvg --mode basis --gop 4 " + options);
    return chunks("hand.tvg", "PLAN").size();
  };
  EXPECT_EQ(periods("--period all"), 1U);
  EXPECT_EQ(periods(""), 1U);
  EXPECT_EQ(periods("--period 5"), 3U);
  EXPECT_EQ(periods("--period 65536"), 1U);
  for (const char* const wrong : {"0", "x", "-1", "5x", "65537", "1e3", "nan", "''"})
    expect_usage_error(std::string("--mode basis --period=") + wrong, "--period");
}

TEST_F(BasisTest, EffortIs1To9AndMoreIsNoLarger) {
  for (const char* const wrong : {"0", "10", "x", "-1"})
    expect_usage_error(std::string("--mode basis --effort=") + wrong, "--effort");
  good("tvg encode hand.obj hand.pc2 -o fast.tvg --mode basis --effort 1");
  good("tvg encode hand.obj hand.pc2 -o small.tvg --mode basis --effort 9");
  EXPECT_LE(folder_.read("small.tvg").size(), folder_.read("fast.tvg").size());
}

TEST_F(BasisTest, OptionsThatDoNotFitTogetherAreUsageErrors) {
  expect_usage_error("--period 4", "--period needs --mode basis");
  expect_usage_error("--period 4 --mode elp", "--period needs --mode basis");
  expect_usage_error("--mode basis --predictor auto", "--predictor");
  expect_usage_error("--mode basis --bits 17", "1 to 16 bits");
  expect_usage_error("--mode basis --lossless", "--lossless");
  expect_usage_error("--max-error 0.01 --bits 12", "--max-error");
  expect_usage_error("--max-error 0.01 --step 0.1", "--max-error");
  expect_usage_error("--max-error 0.01 --lossless", "--lossless");
  expect_usage_error("--max-error 0.01 --important 35%", "13:11");
}

TEST_F(BasisTest, TheLargestErrorIsALengthOrAShareOfTheDiagonalAndHonouredInBothModes) {
  const double diagonal = json("tvg compare hand.pc2 hand.pc2 --mesh hand.obj --json")["diagonal"];
  for (const std::string mode : {"elp", "basis"}) {
    good("tvg encode hand.obj hand.pc2 -o length.tvg --max-error 0.01 --mode " + mode);
    EXPECT_LE(largest_error("length.tvg"), 0.01) << mode;
    EXPECT_GT(largest_error("length.tvg"), 0.004) << mode;
    const Outcome share = good("tvg encode hand.obj hand.pc2 -o share.tvg --max-error 0.05% --mode " + mode);
    EXPECT_LE(largest_error("share.tvg"), 0.0005 * diagonal) << mode;
    EXPECT_EQ(share.err.find("no coordinate is off by more than") != std::string::npos, mode == "basis");
  }
  for (const char* const wrong : {"-1", "0", "nan", "inf", "x", "%", "0%", "1x", "-0.1%", "''"})
    expect_usage_error(std::string("--max-error=") + wrong, "--max-error");
  expect_usage_error("--max-error 1e-12", "float32");
}

TEST_F(BasisTest, AShareOfTheDiagonalNeedsInputThatCanBeReadTwice) {
  expect_failure("cat hand.pc2 | tvg encode hand.obj - -o no.tvg --max-error 0.05%", 1, "the mesh's units");
  expect_failure("tvg encode hand.obj hand.pc2 --live -o no.tvg --max-error 0.05%", 1, "as a length");
  good("cat hand.pc2 | tvg encode hand.obj - -o hand.tvg --max-error 0.01 --mode basis");
  EXPECT_LE(largest_error("hand.tvg"), 0.01 * 1.0001);
}

TEST_F(BasisTest, ALiveStreamHasAPeriodPerGop) {
  good(
      "tvg encode hand.obj hand.pc2 --live --fps 600 --gop 4 --mode basis -o live.tvg && tvg verify "
      "live.tvg");
  EXPECT_EQ(chunks("live.tvg", "PLAN").size(), 3U);
  EXPECT_EQ(chunks("live.tvg", "GOP ").size(), 3U);
  good("tvg encode hand.obj hand.pc2 --live --fps 600 --gop 4 --period 8 --mode basis -o live.tvg");
  EXPECT_EQ(chunks("live.tvg", "PLAN").size(), 2U);
}

TEST_F(BasisTest, FewerComponentsGiveCoarserFramesAndAllGiveTheSame) {
  good(
      "tvg encode hand.obj hand.pc2 -o hand.tvg --mode basis --bits 14 --gop 5 && tvg decode hand.tvg -o "
      "a.pc2");
  const std::uint32_t components = json("tvg info hand.tvg --json")["gops"][0]["components"];
  ASSERT_GT(components, 4U);
  good("tvg decode hand.tvg -o b.pc2 --components " + std::to_string(components) + " && cmp a.pc2 b.pc2");
  good("tvg decode hand.tvg -o few.pc2 --components 4 --threads 1");
  good("tvg decode hand.tvg -o ahead.pc2 --components 4 --threads 3 && cmp few.pc2 ahead.pc2");
  EXPECT_GT(rms_error("few.pc2"), 2 * rms_error("hand.tvg"));
  for (const char* const wrong : {"0", "x", "-1", "65536"})
    expect_failure(std::string("tvg decode hand.tvg -o no.pc2 --components=") + wrong, 1, "--components");
}

TEST_F(BasisTest, ADamagedChunkOfPlanesCostsThePeriodAndNoMore) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --mode basis --period 4 --gop 2");
  const auto plans = chunks("hand.tvg", "PLAN");
  ASSERT_EQ(plans.size(), 3U);
  flip_byte("hand.tvg", plans[1].first + plans[1].second / 2);
  const Outcome verified = run("tvg verify hand.tvg");
  EXPECT_EQ(verified.status, 3);
  EXPECT_THAT(verified.out + verified.err, HasSubstr("8 frames decoded"));
  expect_failure("tvg decode hand.tvg -o no.pc2", 3, "hand.tvg");
  good("tvg decode hand.tvg -o held.pc2 --conceal");
}

}  // namespace
}  // namespace tvg::cli::testing
