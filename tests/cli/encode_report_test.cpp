#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

class EncodeReportTest : public ToolTest {};

TEST_F(EncodeReportTest, JsonIsAllThatIsOnStandardOutputAndSaysWhatTheStreamHas) {
  const Outcome result = good("tvg encode hand.obj hand.pc2 --gop 5 --json -o hand.tvg");
  EXPECT_EQ(result.err, "");
  const nlohmann::json report = nlohmann::json::parse(result.out);
  const nlohmann::json info = json("tvg info --json hand.tvg");
  EXPECT_EQ(report["file"], "hand.tvg");
  EXPECT_EQ(report["gops"], info["gops"].size());
  for (const char* key : {"frames", "vertices", "meshes", "bytes", "bits_per_coordinate"})
    EXPECT_EQ(report[key], info[key]) << key;
  EXPECT_EQ(report["bytes"], std::filesystem::file_size(folder_.path("hand.tvg")));
  EXPECT_NEAR(report["ratio"].get<double>() * report["bits_per_coordinate"].get<double>(), 32, 1e-6);
  EXPECT_TRUE(report["largest_error"].is_null());
  EXPECT_GT(report["seconds"].get<double>(), 0);
}

TEST_F(EncodeReportTest, JsonHasTheLargestErrorWhereItIsKnown) {
  const nlohmann::json report = json("tvg encode hand.obj hand.pc2 --mode basis --json -o hand.tvg");
  EXPECT_GT(report["largest_error"].get<double>(), 0);
}

TEST_F(EncodeReportTest, JsonIsRefusedWhereTheStreamGoesToStandardOutput) {
  expect_failure("tvg encode hand.obj hand.pc2 --json -o -", 1, "--json prints to standard output");
  EXPECT_EQ(run("tvg encode hand.obj hand.pc2 --json -o -").out, "");
}

}  // namespace
}  // namespace tvg::cli::testing
