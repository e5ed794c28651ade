#include "tool_test_fixture.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace tvg::cli::testing {
namespace {

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST_F(ToolTest, TheReadmesDecoderExampleIsTheOneThatIsCompiledAndRuns) {
  const std::string readme = read(std::string(TVG_PROJECT) + "/README.md");
  const std::string example = read(std::string(TVG_PROJECT) + "/tests/readme/decode_frames.cpp");
  ASSERT_FALSE(example.empty());
  EXPECT_NE(readme.find("```cpp\n" + example + "```\n"), std::string::npos);

  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  const Outcome frames = good(std::string(TVG_README_EXAMPLE) + " <hand.tvg");
  EXPECT_EQ(std::count(frames.out.begin(), frames.out.end(), '\n'), static_cast<std::ptrdiff_t>(kFrames));
  EXPECT_NEAR(std::stod(frames.out), hand_.frames[0][0], 0.01);
}

TEST_F(ToolTest, TheReadmeShowsTheVelocityCriterionAsItIs) {
  const std::string readme = read(std::string(TVG_PROJECT) + "/README.md");
  const std::string code = read(std::string(TVG_PROJECT) + "/libcodec/measure/velocity.cpp");
  const std::size_t begin = code.find("std::vector<double> velocity_criterion");
  const std::size_t end = code.find("\n}\n", begin);
  ASSERT_NE(end, std::string::npos);
  EXPECT_NE(readme.find(code.substr(begin, end - begin + 3)), std::string::npos);
  const std::string table = read(std::string(TVG_PROJECT) + "/libcodec/measure/criterion.cpp");
  const std::string line = R"(    {"velocity", "mean way from frame to frame", velocity_criterion},)";
  EXPECT_NE(table.find(line), std::string::npos);
  EXPECT_NE(readme.find(line), std::string::npos);
}

TEST_F(ToolTest, TheReadmeNamesEveryCommandAndOption) {
  const std::string readme = read(std::string(TVG_PROJECT) + "/README.md");
  std::vector<std::string> commands = {"encode", "decode", "info", "verify", "compare", "measure", "join"};
#ifdef TVG_HAS_PLAYER
  commands.insert(commands.end(), {"play", "render", "serve"});
#endif
  for (const std::string& command : commands) {
    EXPECT_NE(readme.find("`tvg " + command), std::string::npos) << command;
    std::istringstream words(good("tvg " + command + " --help").out);
    for (std::string word; words >> word;) {
      const std::size_t dashes = word.find("--");
      if (dashes == std::string::npos) continue;
      const std::string option = word.substr(dashes, word.find_first_of(",):", dashes) - dashes);
      if (option == "--help") continue;
      EXPECT_NE(readme.find(option), std::string::npos) << command << " " << option;
    }
  }
}

}  // namespace
}  // namespace tvg::cli::testing
