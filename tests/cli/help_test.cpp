#include "tool_test_fixture.hpp"

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace tvg::cli::testing {
namespace {

/// "--bits" and the like, as `--help` lists them in its first column.
std::vector<std::string> listed_options(const std::string& help) {
  std::vector<std::string> options;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("--");
    if (line.rfind("  -", 0) != 0 || at > 8) continue;
    options.push_back(line.substr(at, line.find_first_of(" ,", at) - at));
  }
  return options;
}

TEST_F(ToolTest, HelpOfACommandIsWhatTheCommandSaysOfItself) {
  const std::vector<std::string> commands = listed_commands();
  ASSERT_GT(commands.size(), 9u);
  for (const std::string& command : commands)
    EXPECT_EQ(good("tvg help " + command).out, good("tvg " + command + " --help").out) << command;
}

TEST_F(ToolTest, TheVersionHasAShortName) {
  EXPECT_EQ(good("tvg -v").out, good("tvg --version").out);
}

TEST_F(ToolTest, AMistypedWordIsAnsweredWithTheOneThatWasMeant) {
  const std::vector<std::pair<std::string, std::string>> answers = {
      {"tvg enocde", "tvg: enocde is no command: did you mean encode?\n"},
      {"tvg --versoin", "tvg: there is no option --versoin; did you mean --version?\n"},
      {"tvg help simplfy", "tvg: simplfy is no command: did you mean simplify?\n"},
      {"tvg encode hand.obj hand.pc2 -o a.tvg --bit 13",
       "tvg encode: there is no option --bit; did you mean --bits?\n"},
      {"tvg encode hand.obj --prediktor=elp",
       "tvg encode: there is no option --prediktor; did you mean --predictor?\n"},
      {"tvg decode a.tvg -o b.pc2 --wormhole",
       "tvg decode: there is no option --wormhole; tvg help decode lists all\n"},
      {"tvg decode", "tvg decode: input is required; tvg help decode shows how it is used\n"}};
  for (const auto& [line, answer] : answers) {
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.status, 1) << line;
    EXPECT_EQ(outcome.err, answer) << line;
  }
}

TEST_F(ToolTest, EveryCommandHasAManualPageWithAllItsOptions) {
  const std::string all = good("tvg help --man").out;
  for (const std::string& command : listed_commands()) {
    EXPECT_NE(all.find("\\fBtvg\\-" + command + "\\fR(1)"), std::string::npos) << command;
    const std::string page = good("tvg help --man " + command).out;
    EXPECT_EQ(page.rfind(".TH \"TVG-", 0), 0u) << command;
    for (const std::string& option : listed_options(good("tvg help " + command).out)) {
      std::string escaped;
      for (const char letter : option) escaped += letter == '-' ? "\\-" : std::string(1, letter);
      EXPECT_NE(page.find("\\fB" + escaped + "\\fR"), std::string::npos) << command << " " << option;
    }
  }
}

/// Installed pages go by these files.
TEST_F(ToolTest, EveryCommandIsAFileOfItsOwn) {
  for (const std::string& command : listed_commands()) {
    const std::string file = std::string(TVG_PROJECT) + "/cli/" + command + "_command.cpp";
    EXPECT_TRUE(std::filesystem::exists(file)) << file;
  }
}

TEST_F(ToolTest, BashCompletesCommandsOptionsAndChoices) {
  good("tvg help --completion bash >completion.bash");
  const auto completed = [&](const std::string& words, int place) {
    folder_.write("complete.bash", "source ./completion.bash\nCOMP_WORDS=(" + words + ")\nCOMP_CWORD=" +
                                       std::to_string(place) + "\n_tvg\necho \"${COMPREPLY[*]}\"\n");
    return good("bash complete.bash").out;
  };
  EXPECT_EQ(completed("tvg enc", 1), "encode\n");
  EXPECT_EQ(completed("tvg encode --lossl", 2), "--lossless\n");
  EXPECT_EQ(completed("tvg encode --mode ''", 3), "elp basis\n");
  EXPECT_EQ(completed("tvg help ver", 2), "verify\n");
  folder_.write("only_here.tvg", "");
  EXPECT_EQ(completed("tvg info only_h", 2), "only_here.tvg\n");
}

TEST_F(ToolTest, CompletionsOfOtherShellsNameEveryCommand) {
  const std::string zsh = good("tvg help --completion zsh").out;
  const std::string fish = good("tvg help --completion fish").out;
  EXPECT_EQ(zsh.rfind("#compdef tvg\n", 0), 0u);
  for (const std::string& command : listed_commands()) {
    EXPECT_NE(zsh.find("'" + command + ":"), std::string::npos) << command;
    EXPECT_NE(fish.find("-a " + command + " -d "), std::string::npos) << command;
  }
  EXPECT_EQ(run("tvg help --completion csh").status, 1);
}

}  // namespace
}  // namespace tvg::cli::testing
