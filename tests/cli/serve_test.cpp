#include "tool_test_fixture.hpp"

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Shell functions for a server in the background: `serve` starts it and sets U, its URL, and S, its process;
/// `watch NAME FILE` stores a live stream, for which it waits until it has begun.
constexpr const char* kFunctions = R"(
serve() {
  rm -f url
  tvg serve . --port 0 >url 2>log & S=$!
  for i in $(seq 500); do [ -s url ] && break; sleep 0.02; done
  U=$(cat url); P=${U##*:}; P=${P%/}
}
watch() {
  for i in $(seq 200); do
    exec 3<>/dev/tcp/127.0.0.1/$P
    printf 'GET /live/%s HTTP/1.0\r\n\r\n' $1 >&3
    LC_ALL=C cat <&3 >$2.http
    exec 3>&-
    grep -qa '404 Not Found' $2.http || break
    sleep 0.02
  done
  LC_ALL=C sed '1,/^\r$/d' $2.http >$2
}
until_size() { for i in $(seq 200); do [ $(stat -c %s $1 2>/dev/null || echo 0) -gt $2 ] && break; sleep 0.02; done; }
)";

class ServeTest : public ToolTest {
 protected:
  void SetUp() override {
#ifndef TVG_HAS_PLAYER
    GTEST_SKIP() << "this tvg was built without a server";
#endif
    folder_.write("functions", kFunctions);
  }
  Outcome script(const std::string& text) const {
    return run(". ./functions; " + text);
  }
};

TEST_F(ServeTest, ASignalEndsItCleanlyAndItsUrlIsPrinted) {
  for (const char* signal : {"TERM", "INT"}) {
    const Outcome result = script(std::string("serve; kill -") + signal + " $S; wait $S; echo $?; cat url");
    EXPECT_THAT(result.out, HasSubstr("0\nhttp://127.0.0.1:")) << result.err;
  }
}

TEST_F(ServeTest, ATakenPortAndAMissingFolderAreIoErrors) {
  const Outcome taken = script("serve; tvg serve . --port $P; echo $?; kill $S; wait $S");
  EXPECT_THAT(taken.out, ::testing::StartsWith("2\n"));
  EXPECT_THAT(taken.err, HasSubstr("another program does; choose another with --port"));
  expect_failure("tvg serve gone", 2, "gone");
  expect_failure("tvg serve hand.obj", 2, "no folder");
  expect_failure("tvg serve . --port 99999", 1, "--port");
}

TEST_F(ServeTest, BrowsersGetThePlayer) {
  expect_failure("tvg serve . --player nowhere", 2, "npm ci");
  folder_.write("player/index.html",
                "<link href=\"player.css\"><main id=\"player\"></main><script src=\"player.js\"></script>");
  for (const char* name : {"player.js", "player.css", "tvg.wasm"})
    folder_.write(std::string("player/") + name, name);
  good("tvg encode hand.obj hand.pc2 -q -o hand.tvg");
  const Outcome result = script(
      "ask() { exec 3<>/dev/tcp/127.0.0.1/$P; printf 'GET %s HTTP/1.0\\r\\nHost: a\\r\\nAccept: "
      "text/html\\r\\n"
      "\\r\\n' $1 >&3; cat <&3; exec 3>&-; };"
      "rm -f url; tvg serve . --port 0 --player player >url 2>log & S=$!;"
      "for i in $(seq 500); do [ -s url ] && break; sleep 0.02; done; U=$(cat url); P=${U##*:}; P=${P%/};"
      "ask /; ask '/?stream=hand.tvg'; ask /.tvg/player.js; kill $S; wait $S");
  EXPECT_THAT(result.out, HasSubstr("<a href=\"/?stream=hand.tvg\">hand.tvg</a>")) << result.err;
  EXPECT_THAT(result.out, HasSubstr("<script src=\"/.tvg/player.js\">"));
  EXPECT_THAT(result.out, ::testing::EndsWith("\r\n\r\nplayer.js"));
}

TEST_F(ServeTest, AFileGoesLiveAndIsWatched) {
  const Outcome result = script(
      "serve; tvg encode hand.obj hand.pc2 --live --gop 3 --fps 60 -o ${U}live/cam & E=$!;"
      "watch cam got.tvg; wait $E; echo $?; tvg verify got.tvg; kill $S; wait $S; cat log");
  EXPECT_THAT(result.out, ::testing::StartsWith("0\n")) << result.err;
  EXPECT_THAT(result.out, HasSubstr("got.tvg: valid"));
  EXPECT_THAT(result.out, HasSubstr("live cam: ends after 12 frames in 4 GOPs: complete"));
}

TEST_F(ServeTest, ABasisGoesLiveAPeriodPerGop) {
  const Outcome result = script(
      "serve; tvg encode hand.obj hand.pc2 --live --mode basis --gop 3 --fps 60 -o ${U}live/cam & E=$!;"
      "watch cam got.tvg; wait $E; echo $?; tvg verify got.tvg; kill $S; wait $S; cat log");
  EXPECT_THAT(result.out, ::testing::StartsWith("0\n")) << result.err;
  EXPECT_THAT(result.out, HasSubstr("got.tvg: valid"));
  EXPECT_THAT(result.out, HasSubstr("live cam: ends after 12 frames in 4 GOPs: complete"));
  EXPECT_EQ(chunks("got.tvg", "PLAN").size(), chunks("got.tvg", "GOP ").size());
}

TEST_F(ServeTest, AKilledEncoderLeavesAWholeStreamAndAFreeName) {
  const Outcome result = script(
      "serve; tvg encode hand.obj hand.pc2 --live --loop --gop 3 --fps 60 -q -o ${U}live/cam & E=$!;"
      "watch cam got.tvg & W=$!; until_size got.tvg.http 6000; kill -9 $E; wait $W; tvg verify got.tvg;"
      "tvg encode hand.obj hand.pc2 -q -o ${U}live/cam; echo again $?; kill $S; wait $S");
  EXPECT_THAT(result.out, HasSubstr("got.tvg: valid")) << result.err;
  EXPECT_THAT(result.out, HasSubstr("again 0"));
}

TEST_F(ServeTest, AKilledServerEndsTheEncoderWithItsUrlAndCutsViewers) {
  const Outcome result = script(
      "serve; tvg encode hand.obj hand.pc2 --live --loop --gop 3 --fps 60 -q -o ${U}live/cam & E=$!;"
      "watch cam got.tvg & W=$!; until_size got.tvg.http 6000; kill -9 $S; wait $E; echo encoder $?; wait $W;"
      "tvg verify got.tvg; echo viewer $?");
  EXPECT_THAT(result.out, HasSubstr("encoder 2")) << result.err;
  EXPECT_THAT(result.err, HasSubstr("tvg: cannot upload to http://127.0.0.1:"));
  EXPECT_THAT(result.out, HasSubstr("truncated"));
  EXPECT_THAT(result.out, HasSubstr("viewer 3"));
}

TEST_F(ServeTest, AnEndingServerEndsViewersProperlyAndTheEncoderWithStatus2) {
  const Outcome result = script(
      "serve; tvg encode hand.obj hand.pc2 --live --loop --gop 3 --fps 60 -q -o ${U}live/cam & E=$!;"
      "watch cam got.tvg & W=$!; until_size got.tvg.http 6000; kill $S; wait $S; echo server $?; wait $E;"
      "echo encoder $?; wait $W; tvg verify got.tvg");
  EXPECT_THAT(result.out, HasSubstr("server 0\nencoder 2")) << result.err;
  EXPECT_THAT(result.out, HasSubstr("got.tvg: valid"));
}

TEST_F(ServeTest, ARefusedUploadSaysWhatTheServerSays) {
  const Outcome result = script(
      "serve; tvg encode hand.obj hand.pc2 -o ${U}live/; echo $?;"
      "tvg encode hand.obj hand.pc2 -o ${U}x.tvg; echo $?; kill $S; wait $S;"
      "tvg encode hand.obj hand.pc2 -o ${U}live/cam; echo $?");
  EXPECT_EQ(result.out, "2\n2\n2\n") << result.err;
  EXPECT_THAT(result.err, HasSubstr("the server answers 400: publish to /live/NAME"));
  EXPECT_THAT(result.err, HasSubstr("the server answers 405"));
}

class LiveEncodeTest : public ToolTest {
 protected:
  LiveEncodeTest() {
    const std::string cache = folder_.read("hand.pc2");
    folder_.write("unknown.pc2", cache.substr(0, 28) + std::string(4, '\0') + cache.substr(32));
    folder_.write("promise.pc2", cache.substr(0, 28) + std::string("\xff\xff\0\0", 4) + cache.substr(32));
  }
  std::size_t frame_bytes() const { return 12 * std::size_t{hand_.mesh.vertex_count}; }
};

TEST_F(LiveEncodeTest, APipeEndsWhereItEndsWhateverItsHeaderSays) {
  for (const char* cache : {"unknown.pc2", "promise.pc2", "hand.pc2"}) {
    good(std::string("cat ") + cache +
         " | tvg encode hand.obj - --live --gop 5 -o live.tvg && tvg verify live.tvg");
    EXPECT_EQ(json("tvg info live.tvg --json")["frames"], kFrames) << cache;
  }
  expect_failure("cat unknown.pc2 | tvg encode hand.obj - -o no.tvg", 3, "no frames");
  expect_failure("cat promise.pc2 | tvg encode hand.obj - -o no.tvg", 3, "standard input ends at byte");
}

TEST_F(LiveEncodeTest, AFrameCutShortIsLeftOutWithANote) {
  const std::string size = std::to_string(32 + 7 * frame_bytes() + 50);
  const Outcome result = good(
      "head -c " + size + " unknown.pc2 | tvg encode hand.obj - --live -o live.tvg && tvg verify live.tvg");
  EXPECT_THAT(result.err, HasSubstr("inside frame 7"));
  EXPECT_THAT(result.err, HasSubstr("that frame is left out"));
  EXPECT_EQ(json("tvg info live.tvg --json")["frames"], 7);
}

TEST_F(LiveEncodeTest, AGopLeavesAsSoonAsItIsComplete) {
  const std::string size = std::to_string(32 + 7 * frame_bytes());
  const Outcome result = run(
      "{ head -c " + size +
      " hand.pc2; for i in $(seq 500); do [ -e enough ] && break; sleep 0.02; done; } | "
      "tvg encode hand.obj - --live --gop 3 -q -o - >out.tvg & "
      "for i in $(seq 200); do tvg verify out.tvg 2>&1 | grep '6 frames decoded' && break; sleep 0.02; done; "
      "touch enough; wait; tvg verify out.tvg");
  EXPECT_THAT(result.out, HasSubstr("6 frames decoded")) << result.err;
  EXPECT_THAT(result.out, HasSubstr("valid, 7 frames"));
}

TEST_F(LiveEncodeTest, AFileIsGivenOutAtItsRateAndGopsAreShort) {
  good("tvg encode hand.obj hand.pc2 --live --fps 600 -o live.tvg && tvg verify live.tvg");
  EXPECT_EQ(json("tvg info live.tvg --json")["limits"]["frames_per_gop"], 15);
  good("tvg encode hand.obj hand.pc2 --live --fps 600 --gop 4 -o live.tvg");
  EXPECT_EQ(chunks("live.tvg", "GOP ").size(), 3U);
  const Outcome slow = run("time -p tvg encode hand.obj hand.pc2 --live --fps 24000/1001 -q -o live.tvg");
  EXPECT_GE(std::stod(slow.err.substr(slow.err.find("real") + 5)), 11 / 24.0);
}

TEST_F(LiveEncodeTest, LoopingGoesOnUntilStopped) {
  const Outcome result = run(
      "tvg encode hand.obj hand.pc2 --live --loop --fps 600 --gop 5 -q -o - >out.tvg & E=$!; "
      "for i in $(seq 200); do tvg verify out.tvg 2>&1 | grep -E ' ([3-9][0-9]|[0-9]{3,}) frames decoded' && "
      "break; "
      "sleep 0.02; done; kill $E; wait $E");
  EXPECT_THAT(result.out, HasSubstr("frames decoded"));
}

TEST_F(LiveEncodeTest, OptionsThatDoNotFitTogetherAreUsageErrors) {
  expect_failure("tvg encode hand.obj hand.pc2 --loop -o no.tvg", 1, "--live");
  expect_failure("tvg encode hand.obj hand.pc2 --live --threads 2 -o no.tvg", 1, "--threads");
  expect_failure("cat hand.pc2 | tvg encode hand.obj - --live --loop -o no.tvg", 1, "--loop needs a file");
  expect_failure("tvg encode hand.obj hand.pc2 --live --fps never -o no.tvg", 1, "30000/1001");
}

}  // namespace
}  // namespace tvg::cli::testing
