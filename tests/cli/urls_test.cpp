#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

/// `serve` begins a server in the background: U is its URL, S its process. `cut` begins one that promises a
/// long stream, sends the first 3000 bytes of hand.tvg and closes the connection, each time it is asked.
constexpr const char* kFunctions = R"(
await_url() { for i in $(seq 500); do [ -s url ] && break; sleep 0.02; done; U=$(cat url); }
serve() { rm -f url; tvg serve . --port 0 >url 2>log & S=$!; await_url; }
cut() { rm -f url; timeout 60 python3 cut.py >url & S=$!; await_url; }
)";

constexpr const char* kCut = R"(
import socket
server = socket.create_server(('127.0.0.1', 0))
print('http://127.0.0.1:%d/' % server.getsockname()[1], flush=True)
while True:
    connection = server.accept()[0]
    connection.recv(65536)
    connection.sendall(b'HTTP/1.1 200 OK\r\nAccept-Ranges: none\r\nContent-Length: 1000000\r\n\r\n'
                       + open('hand.tvg', 'rb').read()[:3000])
    connection.close()
)";

class UrlsTest : public ToolTest {
 protected:
  void SetUp() override {
#ifndef TVG_HAS_PLAYER
    GTEST_SKIP() << "this tvg was built without HTTP";
#endif
    folder_.write("functions", kFunctions);
    folder_.write("cut.py", kCut);
    good("tvg encode hand.obj hand.pc2 --gop 4 -q -o hand.tvg");
  }
  Outcome script(const std::string& text) const {
    return run(". ./functions; " + text);
  }
  /// Runs `text` with a server of the folder, which ends after it; the status is that of `text`.
  Outcome served(const std::string& text) const {
    return script("serve; " + text + "; R=$?; kill $S; wait $S; (exit $R)");
  }
};

TEST_F(UrlsTest, CommandsReadAnAddressAsTheyReadTheFile) {
  const Outcome result = served(
      "tvg info ${U}hand.tvg | tail -n +2 >a; tvg info hand.tvg | tail -n +2 >b; cmp a b &&"
      "tvg info --bits ${U}hand.tvg | tail -n +2 >a; tvg info --bits hand.tvg | tail -n +2 >b; cmp a b &&"
      "tvg verify ${U}hand.tvg &&"
      "tvg decode -q ${U}hand.tvg -o a.pc2 && tvg decode -q hand.tvg -o b.pc2 && cmp a.pc2 b.pc2 &&"
      "tvg decode -q ${U}hand.tvg --frames 9-10 -o a.pc2 && tvg decode -q hand.tvg --frames 9-10 -o b.pc2 &&"
      "cmp a.pc2 b.pc2 && tvg compare --json hand.tvg ${U}hand.tvg >/dev/null &&"
      "tvg join -q ${U}hand.tvg hand.tvg -o a.tvg && tvg join -q hand.tvg hand.tvg -o b.tvg && cmp a.tvg "
      "b.tvg");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("hand.tvg: valid, 12 frames"));
}

TEST_F(UrlsTest, AnAddressNeedsNoEndingAndMayHaveAQuery) {
  const Outcome result =
      served("cp hand.tvg hand; tvg verify ${U}hand && tvg compare hand.tvg ${U}hand.tvg?a=1");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
}

TEST_F(UrlsTest, ALiveStreamIsReadOnce) {
  const Outcome result = served(
      "tvg encode hand.obj hand.pc2 --live --gop 3 --fps 30 -q -o ${U}live/cam & E=$!;"
      "for i in $(seq 100); do tvg verify ${U}live/cam && break; sleep 0.02; done; wait $E");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("/live/cam: valid"));
}

TEST_F(UrlsTest, APageTakesTheStreamAlong) {
  folder_.write("player/index.html", "<html><head></head><body><main id=\"player\"></main></body></html>");
  for (const char* name : {"player.js", "player.css", "tvg.wasm"})
    folder_.write(std::string("player/") + name, name);
  const Outcome result =
      served("tvg page -q --no-poster --player player ${U}hand.tvg -o p; cmp p/clip.tvg hand.tvg");
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(UrlsTest, PicturesAreDrawnOfAnAddress) {
  const Outcome result = served(
      "tvg render -q ${U}hand.tvg --frames 3 -o a.png; tvg render -q hand.tvg --frames 3 -o b.png; cmp a.png "
      "b.png");
  if (result.err.find("cannot draw without a display") != std::string::npos)
    GTEST_SKIP() << "this machine cannot draw";
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(UrlsTest, WhatIsNotThereIsAnIoErrorThatNamesTheAddress) {
  for (const char* command : {"info", "verify", "decode -o x.pc2", "compare hand.tvg", "join -o x.tvg"}) {
    const Outcome result = served(std::string("tvg ") + command + " ${U}gone.tvg");
    EXPECT_EQ(result.status, 2) << command << result.err;
    EXPECT_THAT(result.err, HasSubstr("gone.tvg: the server answers with status 404 (not found)")) << command;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path("x.pc2")));
}

TEST_F(UrlsTest, ARefusedConnectionIsAnIoError) {
  const Outcome result = script("serve; kill $S; wait $S; tvg verify ${U}hand.tvg");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("hand.tvg: "));
  EXPECT_THAT(result.err, HasSubstr("onnect"));
}

TEST_F(UrlsTest, ACutConnectionIsAnIoErrorAndLeavesNoFile) {
  if (run("command -v python3").status != 0) GTEST_SKIP() << "no python3";
  const Outcome result = script(
      "cut; tvg join ${U}hand.tvg -o joined.tvg; R=$?; kill $S; wait $S 2>/dev/null; ls -A | grep joined;"
      "(exit $R)");
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("hand.tvg: "));
}

}  // namespace
}  // namespace tvg::cli::testing
