#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

TEST_F(ToolTest, NumbersThatMakeNoSenseAreRefusedForEveryOption) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  struct Option {
    std::string command;
    bool zero;      ///< whether 0 makes sense
    bool negative;  ///< whether -1 makes sense
  };
  const std::string encode = "tvg encode hand.obj hand.pc2 -o no.tvg --bits 13:11 ";
  std::vector<Option> options = {
      {encode + "--important-above", true, true},
      {encode + "--alpha", true, false},
      {encode + "--measure skel --skel-alpha", true, false},
      {encode + "--measure skel --skel-threshold", true, false},
      {encode + "--smooth", true, false},
      {encode + "--gop", false, false},
      {encode + "--threads", false, false},
      {encode + "--fps", false, false},
      {encode + "--meta fps=", false, false},
      {"tvg encode hand.obj hand.pc2 -o no.tvg --bits", false, false},
      {"tvg encode hand.obj hand.pc2 -o no.tvg --step", false, false},
      {"tvg encode hand.obj hand.pc2 -o no.tvg --max-error", false, false},
      {"tvg encode hand.obj hand.pc2 -o no.tvg --mode basis --period", false, false},
      {"tvg encode hand.obj hand.pc2 -o no.tvg --effort", false, false},
      {"tvg measure hand.obj hand.pc2 --fps", false, false},
      {"tvg measure hand.obj hand.pc2 --gop", false, false},
      {"tvg measure hand.obj hand.pc2 --ply no.ply --frame", true, false},
      {"tvg info hand.tvg --fps", false, false},
      {"cat hand.tvg | tvg info - --fps", false, false},
      {"tvg compare hand.tvg hand.tvg --fps", false, false},
      {"tvg compare hand.tvg hand.tvg --hausdorff", false, false},
      {"tvg decode hand.tvg -o no.pc2 --frames", true, false},
      {"tvg decode hand.tvg -o no.pc2 --components", false, false},
      {"tvg join hand.tvg -o no.tvg --frames", true, false},
#ifdef TVG_HAS_PLAYER
      {"tvg play gone.tvg --fps", false, false},
      {"tvg play gone.tvg --speed", false, false},
      {"tvg play gone.tvg --seconds", false, false},
      {"tvg play gone.tvg --memory", false, false},
      {"tvg play gone.tvg --start", true, false},
      {"tvg render gone.tvg -o no.png --overlay cost --scale", false, false},
      {"tvg render gone.tvg -o no.mp4 --fps", false, false},
      {"tvg render gone.tvg -o no.png --size", false, false},
      {"tvg render gone.tvg -o no.png --sheet", false, false},
      {"tvg serve gone --port", true, false},
      {"tvg serve gone --max-clients", false, false},
      {"tvg serve gone --max-live-streams", false, false},
      {"tvg serve gone --max-chunk-bytes", false, false},
      {"tvg serve gone --timeout", false, false},
#endif
  };
  for (const Option& option : options) {
    std::vector<std::string> wrong = {"nan", "inf", "-inf", "NaN", "1e999", "x", "1x"};
    if (!option.zero) wrong.insert(wrong.end(), {"0", "-0"});
    if (!option.negative) wrong.push_back("-1");
    for (const std::string& value : wrong) {
      const std::string line = option.command + (option.command.ends_with('=') ? "" : "=") + value;
      const std::string joined = option.command.ends_with("fps=") ? option.command + value : line;
      const Outcome result = run(joined);
      EXPECT_EQ(result.status, 1) << joined << "\n" << result.err;
      EXPECT_NE(result.err, "") << joined;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path("no.tvg")));
}

TEST_F(ToolTest, ARateIsTheSameForEveryKindOfInput) {
  expect_failure("tvg encode hand.obj hand.pc2 -o no.tvg --fps nan", 1, "30000/1001");
  expect_failure("tvg encode hand.obj -o no.tvg --fps 0", 1, "30000/1001");
  expect_failure("tvg encode hand.obj hand.pc2 -o no.tvg --meta fps=fast", 1,
                 "--meta fps=fast: write frames");
  good("tvg encode hand.obj hand.pc2 -o ntsc.tvg --fps 30000/1001");
  EXPECT_EQ(json("tvg info --json ntsc.tvg")["metadata"]["fps"], "30000/1001");
}

TEST_F(ToolTest, AModeThatIsNotThereIsSaidToBeSo) {
  expect_failure("tvg encode hand.obj hand.pc2 -o no.tvg --mode magic", 1, "basis");
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --mode elp");
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --mode basis");
}

}  // namespace
}  // namespace tvg::cli::testing
