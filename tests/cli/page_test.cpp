#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

constexpr const char* kMakePlayer =
    "mkdir player && for f in index.html player.css player.js tvg.wasm; do echo $f >player/$f; done";

TEST_F(ToolTest, APageIsTheStreamAndThePlayersFiles) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  good(kMakePlayer);
  good("tvg page hand.tvg -o site/hand --player player");
  good("cmp hand.tvg site/hand/clip.tvg && rm site/hand/clip.tvg && diff -r player site/hand");
}

TEST_F(ToolTest, APageWithoutThePlayersFilesSaysHowToGetThem) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  expect_failure("tvg page hand.tvg -o site --player nowhere", 2, "npm ci");
  good("test ! -e site");
}

TEST_F(ToolTest, APageOfWhatIsNoStreamIsRefused) {
  good(kMakePlayer);
  expect_failure("tvg page hand.obj -o site --player player", 3, "signature");
  good("test ! -e site");
}

}  // namespace
}  // namespace tvg::cli::testing
