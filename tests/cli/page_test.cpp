#include "tool_test_fixture.hpp"

#ifdef TVG_HAS_PLAYER
#include "player/view/image.hpp"
#endif

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A user who has a player of small files in `player`.
class PageTest : public ToolTest {
 protected:
  PageTest() {
    folder_.write(
        "player/index.html",
        "<!doctype html>\n<title>TVG player</title>\n<link rel=\"stylesheet\" href=\"player.css\">\n"
        "<main id=\"player\" class=\"wide\" data-stream=\"clip.tvg\">\n</main>\n"
        "<script src=\"player.js\"></script>\n");
    folder_.write("player/player.css", "main { color: red }\n");
    folder_.write("player/player.js", "play('</script>', '<!--');\n");
    folder_.write("player/tvg.wasm", std::string("\0asm", 4));
  }

  /// The start tag that the page's script reads.
  std::string player_tag(const std::string& page) const {
    const std::string html = folder_.read(page);
    const std::size_t begin = html.find("<main");
    return begin == std::string::npos ? "" : html.substr(begin, html.find('>', begin) + 1 - begin);
  }
};

TEST_F(PageTest, OfAStreamIsTheStreamAndThePlayersFiles) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  good("tvg page hand.tvg -o site/hand --player player --no-poster");
  good("cmp hand.tvg site/hand/clip.tvg");
  good("for f in player.css player.js tvg.wasm; do cmp player/$f site/hand/$f || exit; done");
  EXPECT_EQ(good("ls -A site/hand").out, "clip.tvg\nindex.html\nplayer.css\nplayer.js\ntvg.wasm\n");
  EXPECT_EQ(player_tag("site/hand/index.html"),
            R"(<main id="player" class="wide" data-stream="clip.tvg" data-title="hand">)");
  EXPECT_THAT(folder_.read("site/hand/index.html"), HasSubstr("<title>hand</title>"));
}

TEST_F(PageTest, IsMadeOfAllThatCanBeEncoded) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  good(
      "mkdir walk && tvg decode hand.tvg -o walk/walk_%04d.obj && tvg decode hand.tvg -o back.npy && "
      "tvg decode hand.tvg -o scene.glb");
  for (const char* input : {"hand.obj hand.pc2", "walk", "walk/walk_%04d.obj", "walk/walk_*.obj",
                            "back.obj back.npy", "scene.glb"}) {
    good(std::string("rm -rf site; tvg page ") + input + " -o site --player player --no-poster");
    const nlohmann::json info = json("tvg info --json site/clip.tvg");
    EXPECT_EQ(info["frames"], kFrames) << input;
    EXPECT_EQ(info["gops"][0]["mode"], "basis") << input;
  }
  EXPECT_THAT(good("tvg page walk/walk_%04d.obj -o named --player player").err,
              HasSubstr("named/index.html"));
  EXPECT_THAT(player_tag("named/index.html"), HasSubstr("data-title=\"walk\""));
}

TEST_F(PageTest, TakesTheOptionsOfEncode) {
  good(
      "tvg page hand.obj hand.pc2 -o site --player player --no-poster --mode elp --bits 9 --gop 4 --fps 24 "
      "-q");
  const nlohmann::json info = json("tvg info --json site/clip.tvg");
  EXPECT_EQ(info["gops"][0]["mode"], "elp");
  EXPECT_EQ(info["gops"].size(), 3U);
  expect_failure("tvg page hand.obj hand.pc2 -o no --player player --bits 99", 1, "--bits");
  good("test ! -e no");
}

TEST_F(PageTest, OptionsOfEncodingAreNotForAStream) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  expect_failure("tvg page hand.tvg -o site --player player --bits 9", 1,
                 "--bits: not for hand.tvg, which is taken as it is");
  expect_failure("tvg page hand.tvg -o site --player player --steps 2", 1, "--ladder");
  good("test ! -e site");
}

#ifdef TVG_HAS_PLAYER
TEST_F(PageTest, HasAPosterOfTheAnimationAndNothingElse) {
  const Outcome made = good("tvg page hand.obj hand.pc2 -o site --player player");
  if (made.err.find("no poster") != std::string::npos) GTEST_SKIP() << made.err;
  EXPECT_THAT(player_tag("site/index.html"), HasSubstr("data-poster=\"poster.png\""));
  const player::Image poster = player::read_png(folder_.path("site/poster.png"));
  std::size_t drawn = 0, clear = 0;
  for (int row = 0; row < poster.height; ++row) {
    for (int column = 0; column < poster.width; ++column) {
      drawn += poster.pixel(column, row)[3] == 255 ? 1 : 0;
      clear += poster.pixel(column, row)[3] == 0 ? 1 : 0;
    }
  }
  const auto all = static_cast<std::size_t>(poster.width * poster.height);
  EXPECT_GT(drawn, all / 50);
  EXPECT_GT(clear, all / 3);
  EXPECT_GT(drawn + clear, all * 95 / 100);
  EXPECT_EQ(poster.pixel(0, 0)[3], 0);
  EXPECT_EQ(poster.pixel(poster.width / 2, poster.height / 2)[3], 255);
}
#endif

TEST_F(PageTest, NamesOfAnyKindAreText) {
  good("mv hand.obj 'a<b>&\"c'\\''.obj' && mv hand.pc2 -- '-x #?%.pc2'");
  good("tvg page 'a<b>&\"c'\\''.obj' './-x #?%.pc2' -o 'si te' --player player --no-poster");
  EXPECT_THAT(player_tag("si te/index.html"), HasSubstr("data-title=\"a&lt;b&gt;&amp;&quot;c&#39;\""));
  EXPECT_THAT(folder_.read("si te/index.html"), HasSubstr("<title>a&lt;b&gt;&amp;&quot;c&#39;</title>"));
  good("tvg page './a<b>&\"c'\\''.obj' './-x #?%.pc2' -o s --player player --no-poster --title '<script>'");
  EXPECT_THAT(folder_.read("s/index.html"), Not(HasSubstr("<script>")));
}

TEST_F(PageTest, InOneFileHasAllInIt) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  good("tvg page hand.tvg -o hand.html --player player --no-poster");
  const std::string html = folder_.read("hand.html");
  EXPECT_THAT(html, HasSubstr("<style>\nmain { color: red }\n</style>"));
  EXPECT_THAT(html, HasSubstr(R"(<script>play('<\/script>', '<\!--');)"));
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, HasSubstr("data-file=\"tvg.wasm\">AGFzbQ==</script>"));
  good(R"(grep -o 'data-file="clip.tvg">[^<]*' hand.html | cut -d'>' -f2 | base64 -d | cmp - hand.tvg)");
  good("tvg page hand.obj hand.pc2 -o made.html --player player --no-poster");
  EXPECT_THAT(folder_.read("made.html"), HasSubstr("data-file=\"clip.tvg\">"));
  EXPECT_EQ(good("ls -A | grep -c tvg").out, "1\n") << "the stream is left over";
}

TEST_F(PageTest, WithoutThePlayersFilesSaysHowToGetThem) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  expect_failure("tvg page hand.tvg -o site --player nowhere", 2, "npm ci");
  good("rm player/tvg.wasm");
  expect_failure("tvg page hand.tvg -o site --player player", 2, "tvg.wasm");
  good("echo >player/tvg.wasm; echo '<p>' >player/index.html");
  expect_failure("tvg page hand.tvg -o site --player player", 3, "no page of the player");
  good("test ! -e site");
}

TEST_F(PageTest, OfWhatIsNoAnimationIsRefusedAndLeavesNothing) {
  expect_failure("tvg page gone.tvg -o a/b --player player", 2, "gone.tvg");
  folder_.write("no.tvg", "this is no stream");
  expect_failure("tvg page no.tvg -o a/b --player player", 3, "signature");
  good("head -c 2000 hand.pc2 >cut.pc2");
  expect_failure("tvg page hand.obj cut.pc2 -o a/b --player player", 3, "cut.pc2");
  expect_failure("tvg page hand.obj cut.pc2 -o a.html --player player", 3, "cut.pc2");
  expect_failure("tvg page hand.obj cut.pc2 -o a/b --ladder --player player", 3, "cut.pc2");
  good("test ! -e a && test ! -e a.html");
}

TEST_F(PageTest, ThatCannotBeWrittenWholeLeavesTheOneBefore) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  good("tvg page hand.obj hand.pc2 -o site --player player --no-poster -q; cp -r site before");
  good("rm site/tvg.wasm && ln -s /dev/full site/tvg.wasm");
  expect_failure("tvg page hand.obj hand.pc2 --bits 8 -o site --player player --no-poster --title new", 2,
                 "No space left");
  good("for f in clip.tvg index.html player.js; do cmp site/$f before/$f || exit; done");
  EXPECT_EQ(good("ls -A site | wc -l").out, "5\n");
}

TEST_F(PageTest, InAFolderThatIsThereReplacesItsOwnFilesOnly) {
  good("mkdir site && echo mine >site/notes.txt");
  good("tvg page hand.obj hand.pc2 -o site --player player --no-poster -q");
  good("tvg page hand.obj hand.pc2 -o site --player player --no-poster --title other -q");
  EXPECT_EQ(folder_.read("site/notes.txt"), "mine\n");
  EXPECT_THAT(player_tag("site/index.html"), HasSubstr("data-title=\"other\""));
  expect_failure("tvg page hand.obj hand.pc2 -o hand.obj --player player", 2, "hand.obj");
}

TEST_F(PageTest, OfAStreamThatIsThereAlreadyLeavesItAlone) {
  good("mkdir site && tvg encode hand.obj hand.pc2 -o site/clip.tvg && cp site/clip.tvg before.tvg");
  good("tvg page site/clip.tvg -o site --player player --no-poster && cmp site/clip.tvg before.tvg");
  EXPECT_THAT(player_tag("site/index.html"), HasSubstr("data-stream=\"clip.tvg\""));
}

TEST_F(PageTest, OfALadderHasAllItsStreams) {
  good("tvg ladder hand.obj hand.pc2 -o steps -q");
  good("tvg page steps -o site --player player --no-poster");
  good("for f in high.tvg medium.tvg low.tvg ladder.json; do cmp steps/$f site/$f || exit; done");
  EXPECT_THAT(player_tag("site/index.html"), HasSubstr("data-stream=\"ladder.json\" data-title=\"steps\""));
  good("tvg page steps -o steps --player player --no-poster && test -e steps/index.html");
  good("tvg page hand.obj hand.pc2 --ladder --steps 2 -o made --player player --no-poster");
  EXPECT_EQ(good("ls made/*.tvg").out, "made/high.tvg\nmade/low.tvg\n");
  EXPECT_THAT(player_tag("made/index.html"), HasSubstr("data-stream=\"ladder.json\""));
  expect_failure("tvg page steps -o one.html --player player", 1, "name a folder");
  expect_failure("tvg page steps --ladder -o no --player player", 1, "a ladder already");
}

TEST_F(PageTest, OfALadderThatLeadsElsewhereIsRefused) {
  for (const char* file : {"../hand.tvg", "/etc/passwd", ".hidden.tvg", ""}) {
    folder_.write("steps/ladder.json",
                  std::string(R"({"tvg_ladder": 1, "streams": [{"file": ")") + file + "\"}]}");
    expect_failure("tvg page steps -o site --player player", 3, "no ladder");
  }
  for (const char* text :
       {"", "[]", "{}", R"({"tvg_ladder": 2, "streams": [{"file": "a.tvg"}]})",
        R"({"tvg_ladder": 1, "streams": {"file": 1}})", R"({"tvg_ladder": 1, "streams": []})"}) {
    folder_.write("steps/ladder.json", text);
    expect_failure("tvg page steps -o site --player player", 3, "no ladder");
  }
  good("test ! -e site");
}

}  // namespace
}  // namespace tvg::cli::testing
