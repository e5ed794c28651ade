#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

/// `command` as typed at a terminal, where `answer` is typed at its question.
std::string at_terminal(const std::string& answer, const std::string& command) {
  return "echo " + answer + " | script -qec '" + command + "' /dev/null";
}

TEST_F(ToolTest, AnOutputWithoutANameIsNamedAfterItsInput) {
  good("tvg encode hand.obj hand.pc2 -q && tvg verify -q hand.tvg");
  good("tvg decode hand.tvg -q && tvg compare hand.pc2 hand_decoded.pc2 --mesh hand.obj");
  EXPECT_EQ(run("tvg encode - <hand.pc2").status, 1);
}

TEST_F(ToolTest, AtATerminalAFileIsReplacedOnlyWhereItsUserSaysSo) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg -q --bits 8 && cp hand.tvg first.tvg");
  const std::string again = "tvg encode hand.obj hand.pc2 -o hand.tvg -q --bits 12";
  const Outcome refused = run(at_terminal("n", again));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.out, HasSubstr("hand.tvg exists; overwrite it (y/n)?"));
  EXPECT_THAT(refused.out, HasSubstr("hand.tvg exists and is kept; --force overwrites it"));
  good("cmp hand.tvg first.tvg && ! ls *.tmp*");
  good(at_terminal("y", again) + " && ! cmp -s hand.tvg first.tvg");
  good("cp first.tvg hand.tvg");
  EXPECT_THAT(good(at_terminal("n", again + " -f")).out, ::testing::Not(HasSubstr("overwrite it")));
  good("! cmp -s hand.tvg first.tvg");
}

TEST_F(ToolTest, AScriptIsNotAsked) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg -q && tvg encode hand.obj hand.pc2 -o hand.tvg -q");
}

}  // namespace
}  // namespace tvg::cli::testing
