#include "tool_test_fixture.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

namespace tvg::cli::testing {
namespace {

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Long options in a text: "--bits".
std::set<std::string> options_in(const std::string& text) {
  std::set<std::string> options;
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 2)) {
    std::size_t end = at + 2;
    while (end < text.size() && (std::islower(static_cast<unsigned char>(text[end])) || text[end] == '-'))
      ++end;
    if (end > at + 3 && (at == 0 || text[at - 1] != '-')) options.insert(text.substr(at, end - at));
  }
  return options;
}

TEST_F(ToolTest, TheManualsDecoderExampleIsTheOneThatIsCompiledAndRuns) {
  const std::string page = read(std::string(TVG_PROJECT) + "/docs/library.md");
  const std::string example = read(std::string(TVG_PROJECT) + "/tests/manual/decode_frames.cpp");
  ASSERT_FALSE(example.empty());
  EXPECT_NE(page.find("```cpp\n" + example + "```\n"), std::string::npos);

  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  const Outcome frames = good(std::string(TVG_MANUAL_EXAMPLE) + " <hand.tvg");
  EXPECT_EQ(std::count(frames.out.begin(), frames.out.end(), '\n'), static_cast<std::ptrdiff_t>(kFrames));
  EXPECT_NEAR(std::stod(frames.out), hand_.frames[0][0], 0.01);
}

TEST_F(ToolTest, TheManualsEncoderExampleIsTheOneThatIsCompiledAndRuns) {
  const std::string page = read(std::string(TVG_PROJECT) + "/docs/library.md");
  const std::string example = read(std::string(TVG_PROJECT) + "/tests/manual/encode_frames.cpp");
  ASSERT_FALSE(example.empty());
  EXPECT_NE(page.find("```cpp\n" + example + "```\n"), std::string::npos);

  good(std::string(TVG_MANUAL_ENCODER) + " >rising.tvg && tvg verify rising.tvg -q");
  const Outcome frames = good(std::string(TVG_MANUAL_EXAMPLE) + " <rising.tvg");
  EXPECT_EQ(std::count(frames.out.begin(), frames.out.end(), '\n'), 90);
}

TEST_F(ToolTest, TheManualShowsTheVelocityCriterionAsItIs) {
  const std::string page = read(std::string(TVG_PROJECT) + "/docs/measure.md");
  const std::string code = read(std::string(TVG_PROJECT) + "/libcodec/measure/velocity.cpp");
  const std::size_t begin = code.find("std::vector<double> velocity_criterion");
  const std::size_t end = code.find("\n}\n", begin);
  ASSERT_NE(end, std::string::npos);
  EXPECT_NE(page.find(code.substr(begin, end - begin + 3)), std::string::npos);
  const std::string table = read(std::string(TVG_PROJECT) + "/libcodec/measure/criterion.cpp");
  const std::string line = R"(    {"velocity", "mean way from frame to frame", velocity_criterion},)";
  EXPECT_NE(table.find(line), std::string::npos);
  EXPECT_NE(page.find(line), std::string::npos);
}

TEST_F(ToolTest, TheManualNamesEveryCommandAndOptionAndNoOther) {
  const std::string page = read(std::string(TVG_PROJECT) + "/docs/commands.md");
  std::set<std::string> known = options_in(good("tvg --help").out);
  for (const std::string& command : listed_commands()) {
    EXPECT_NE(page.find("`tvg " + command), std::string::npos) << command;
    for (const std::string& option : options_in(good("tvg " + command + " --help").out)) {
      known.insert(option);
      if (option == "--help") continue;
      EXPECT_NE(page.find(option), std::string::npos) << command << " " << option;
    }
  }
#ifdef TVG_HAS_PLAYER
  for (const std::string& option : options_in(page)) EXPECT_TRUE(known.contains(option)) << option;
#endif
}

TEST_F(ToolTest, TheReadmeIsShort) {
  const std::string readme = read(std::string(TVG_PROJECT) + "/README.md");
  EXPECT_LE(std::count(readme.begin(), readme.end(), '\n'), 130);
}

/// Every page of the manual is reached from the README, and no link inside the project leads nowhere.
TEST_F(ToolTest, TheManualsLinksLeadSomewhere) {
  const std::filesystem::path project = TVG_PROJECT;
  const std::string readme = read((project / "README.md").string());
  std::vector<std::filesystem::path> pages = {project / "README.md", project / "CONTRIBUTING.md"};
  for (const auto& entry : std::filesystem::directory_iterator(project / "docs")) {
    if (entry.path().extension() != ".md") continue;
    EXPECT_NE(readme.find("(docs/" + entry.path().filename().string() + ")"), std::string::npos)
        << entry.path();
    pages.push_back(entry.path());
  }
  for (const std::filesystem::path& page : pages) {
    const std::string text = read(page.string());
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      const std::string target = text.substr(at + 2, text.find_first_of(")#", at + 2) - at - 2);
      const bool code = target.find(' ') != std::string::npos;
      if (target.empty() || code || target.starts_with("http")) continue;
      EXPECT_TRUE(std::filesystem::exists(page.parent_path() / target)) << target << " in " << page;
    }
  }
}

}  // namespace
}  // namespace tvg::cli::testing
