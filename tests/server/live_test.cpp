#include "server_toolbox.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace tvg::server::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Live : public ::testing::Test {
 protected:
  /// Bytes up to the end of GOP `count`; all GOPs but no end where there are so many.
  std::string until(std::size_t count) const { return text_of(stream_, 0, borders_.at(count)); }
  std::string between(std::size_t first, std::size_t last) const {
    return text_of(stream_, borders_.at(first), borders_.at(last));
  }
  std::string rest(std::size_t first) const { return text_of(stream_, borders_.at(first), stream_.size()); }
  /// Frames of the encoder's own stream from `first` on are what was seen.
  void expect_frames(const std::string& seen, std::size_t first, std::size_t count) const {
    const test::DecodedStream viewed = decode_text(seen);
    EXPECT_TRUE(viewed.complete) << viewed.error.describe();
    EXPECT_TRUE(viewed.damage.empty());
    ASSERT_EQ(viewed.frames.size(), count);
    for (std::size_t f = 0; f < count; ++f) {
      EXPECT_EQ(viewed.frames[f].positions, encoded_.frames[first + f].positions) << f;
      EXPECT_EQ(viewed.frames[f].gop.source_frame, encoded_.frames[first + f].gop.source_frame) << f;
    }
  }
  bool gops_are(std::size_t count) const {
    return eventually([&] {
      const nlohmann::json streams = listing();
      return !streams.empty() && streams[0]["gops"] == count;
    });
  }
  bool viewers_are(std::size_t count) const {
    return eventually([&] {
      const nlohmann::json streams = listing();
      return !streams.empty() && streams[0]["viewers"] == count;
    });
  }
  nlohmann::json listing() const {
    auto answer = server_.client().Get("/live/");
    return answer ? nlohmann::json::parse(answer->body)["streams"] : nlohmann::json::array();
  }

  cli::testing::TemporaryFolder folder_;
  RunningServer server_{folder_.path("")};
  test::Stream stream_ = make_live_stream(8);
  std::vector<std::size_t> borders_ = gop_borders(stream_);
  test::DecodedStream encoded_ = test::decode_stream(stream_);
};

TEST_F(Live, AViewerWhoIsThereFromTheFirstGopGetsEverythingAndAWholeStream) {
  Upload upload(server_, "/live/cam");
  upload.send(until(1));
  ASSERT_TRUE(gops_are(1));
  Viewer viewer(server_, "/live/cam");
  ASSERT_TRUE(viewers_are(1));
  for (std::size_t gop = 1; gop < 8; ++gop) {
    ASSERT_TRUE(eventually([&] { return decode_text(viewer.received()).frames.size() >= 2 * gop; }));
    upload.send(between(gop, gop + 1));
  }
  upload.send(rest(8));
  upload.finish();
  EXPECT_EQ(upload.status(), 200);
  EXPECT_THAT(upload.text(), StartsWith("16 frames in 8 GOPs"));
  viewer.wait();
  EXPECT_TRUE(viewer.whole());
  expect_frames(viewer.received(), 0, 16);
}

TEST_F(Live, WhoJoinsLaterBeginsWithTheNewestCompleteGopAtOnce) {
  Upload upload(server_, "/live/cam");
  upload.send(until(5) + between(5, 6).substr(0, 20));
  ASSERT_TRUE(gops_are(5));
  Viewer viewer(server_, "/live/cam");
  EXPECT_TRUE(eventually([&] { return decode_text(viewer.received()).frames.size() == 2; }));
  upload.send(between(5, 6).substr(20));
  upload.break_off();
  viewer.wait();
  expect_frames(viewer.received(), 8, 4);
}

TEST_F(Live, AnEncoderLostInTheMiddleOfAGopLeavesViewersAWholeStreamAndTheNameFree) {
  for (int round = 0; round < 2; ++round) {
    Upload upload(server_, "/live/cam");
    upload.send(until(1));
    ASSERT_TRUE(gops_are(1));
    Viewer first(server_, "/live/cam"), second(server_, "/live/cam");
    ASSERT_TRUE(viewers_are(2));
    upload.send(between(1, 2).substr(0, 30));
    upload.break_off();
    for (Viewer* viewer : {&first, &second}) {
      viewer->wait();
      EXPECT_TRUE(viewer->whole());
      expect_frames(viewer->received(), 0, 2);
    }
    EXPECT_TRUE(eventually([&] { return listing().empty(); }));
  }
}

TEST_F(Live, AViewerLostIsNoticedByNobody) {
  Upload upload(server_, "/live/cam");
  upload.send(until(1));
  ASSERT_TRUE(gops_are(1));
  Viewer stays(server_, "/live/cam");
  {
    Viewer leaves(server_, "/live/cam");
    ASSERT_TRUE(viewers_are(2));
    ASSERT_TRUE(eventually([&] { return !leaves.received().empty(); }));
    leaves.leave();
  }
  EXPECT_TRUE(viewers_are(1));
  upload.send(between(1, 3));
  ASSERT_TRUE(gops_are(3));
  ASSERT_TRUE(eventually([&] { return decode_text(stays.received()).frames.size() == 6; }));
  upload.break_off();
  stays.wait();
  expect_frames(stays.received(), 0, 6);
}

TEST_F(Live, StoppingTheServerEndsViewersStreamsProperly) {
  Upload upload(server_, "/live/cam");
  upload.send(until(2));
  ASSERT_TRUE(gops_are(2));
  Viewer viewer(server_, "/live/cam");
  ASSERT_TRUE(eventually([&] { return decode_text(viewer.received()).frames.size() == 2; }));
  (*server_).stop();
  viewer.wait();
  EXPECT_TRUE(viewer.whole());
  expect_frames(viewer.received(), 2, 2);
  upload.send(between(2, 3));
  upload.finish();
  EXPECT_NE(upload.status(), 200);
}

TEST_F(Live, BrokenBytesAre400WithTheReasonAndEndViewersProperly) {
  Upload upload(server_, "/live/cam");
  upload.send(until(1));
  ASSERT_TRUE(gops_are(1));
  Viewer viewer(server_, "/live/cam");
  ASSERT_TRUE(viewers_are(1));
  std::string damaged = between(1, 2);
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  upload.send(damaged);
  upload.finish();
  EXPECT_EQ(upload.status(), 400);
  EXPECT_THAT(upload.text(), HasSubstr("a packet is damaged"));
  viewer.wait();
  expect_frames(viewer.received(), 0, 2);
}

TEST_F(Live, WhatIsNoStreamOrEndsTooSoonIs400) {
  Upload foreign(server_, "/live/cam");
  foreign.send("GIF89a....................");
  foreign.finish();
  EXPECT_EQ(foreign.status(), 400);
  EXPECT_THAT(foreign.text(), HasSubstr("signature"));
  Upload cut(server_, "/live/cam");
  cut.send(until(2));
  cut.finish();
  EXPECT_EQ(cut.status(), 400);
  EXPECT_THAT(cut.text(), HasSubstr("ends before it is complete"));
}

TEST_F(Live, ANameIsPublishedByOneAtATime) {
  Upload upload(server_, "/live/cam");
  upload.send(until(1));
  ASSERT_TRUE(gops_are(1));
  auto second = server_.client().Put("/live/cam", text_of(stream_, 0, stream_.size()), "model/vnd.tvg");
  ASSERT_TRUE(second);
  EXPECT_EQ(second->status, 409);
  upload.send(between(1, 8) + rest(8));
  upload.finish();
  EXPECT_EQ(upload.status(), 200);
}

TEST_F(Live, PostPublishesTooAndABodyOfKnownLengthDoes) {
  Upload post(server_, "/live/cam", true);
  post.send(text_of(stream_, 0, stream_.size()));
  post.finish();
  EXPECT_EQ(post.status(), 200);
  auto put = server_.client().Put("/live/cam", text_of(stream_, 0, stream_.size()), "model/vnd.tvg");
  ASSERT_TRUE(put);
  EXPECT_EQ(put->status, 200);
}

TEST_F(Live, NamesThatAreNoNamesAreRefused) {
  const std::string body = text_of(stream_, 0, stream_.size());
  for (const std::string& path :
       {std::string("/live/"), std::string("/live/a%2Fb"), std::string("/live/a/b"),
        std::string("/live/a%00"), std::string("/live/.hidden"), std::string("/live/.."),
        "/live/" + std::string(65, 'a'), std::string("/live/%C3%A4")}) {
    auto put = server_.client().Put(path, body, "model/vnd.tvg");
    ASSERT_TRUE(put) << path;
    EXPECT_EQ(put->status, 400) << path;
  }
  for (const std::string& path : {std::string("/x.tvg"), std::string("/")}) {
    auto put = server_.client().Put(path, body, "model/vnd.tvg");
    ASSERT_TRUE(put) << path;
    EXPECT_EQ(put->status, 405) << path;
  }
  auto page = server_.client().Put("/live/cam", {{"Origin", "https://example.org"}}, body, "text/plain");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 403);
}

TEST_F(Live, WhatIsNotLiveIs404WithAHint) {
  for (const char* path : {"/live/nothing", "/live/a/b"}) {
    auto answer = server_.client().Get(path);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 404);
    EXPECT_THAT(answer->body, HasSubstr("/live/ lists"));
  }
}

TEST_F(Live, TheListingCountsWhatIsThere) {
  EXPECT_TRUE(listing().empty());
  Upload upload(server_, "/live/cam");
  upload.send(until(3));
  ASSERT_TRUE(gops_are(3));
  Viewer viewer(server_, "/live/cam");
  ASSERT_TRUE(viewers_are(1));
  const nlohmann::json entry = listing()[0];
  EXPECT_EQ(entry["name"], "cam");
  EXPECT_EQ(entry["url"], "/live/cam");
  EXPECT_EQ(entry["frames"], 6);
  EXPECT_GT(entry["bytes_per_second"], 0);
  EXPECT_THAT(entry["since"].get<std::string>(), HasSubstr("T"));
}

TEST(LiveLimits, AChunkAboveTheLimitIs413) {
  const cli::testing::TemporaryFolder folder;
  const RunningServer server(folder.path(""), [](ServerOptions& options) { options.max_chunk_bytes = 100; });
  const test::Stream stream = make_live_stream(3);
  auto put = server.client().Put("/live/cam", text_of(stream, 0, stream.size()), "model/vnd.tvg");
  ASSERT_TRUE(put);
  EXPECT_EQ(put->status, 413);
  EXPECT_THAT(put->body, HasSubstr("the limit set here is 100"));
}

TEST(LiveLimits, OneStreamMoreThanAllowedIs503) {
  const cli::testing::TemporaryFolder folder;
  const RunningServer server(folder.path(""), [](ServerOptions& options) { options.max_live_streams = 1; });
  const test::Stream stream = make_live_stream(3);
  const std::string body = text_of(stream, 0, stream.size());
  Upload upload(server, "/live/a");
  upload.send(body.substr(0, 50));
  ASSERT_TRUE(eventually([&] {
    auto list = server.client().Get("/live/");
    return list && list->body.find("\"a\"") != std::string::npos;
  }));
  auto put = server.client().Put("/live/b", body, "model/vnd.tvg");
  ASSERT_TRUE(put);
  EXPECT_EQ(put->status, 503);
  EXPECT_TRUE(put->has_header("Retry-After"));
}

TEST(LiveLimits, WithoutLiveNothingIsTaken) {
  const cli::testing::TemporaryFolder folder;
  const RunningServer server(folder.path(""), [](ServerOptions& options) { options.live = false; });
  auto put = server.client().Put("/live/b", "x", "model/vnd.tvg");
  ASSERT_TRUE(put);
  EXPECT_EQ(put->status, 405);
  auto get = server.client().Get("/live/");
  ASSERT_TRUE(get);
  EXPECT_EQ(get->status, 404);
}

TEST(LiveLimits, OneClientMoreThanAllowedIs503AndTheOthersGoOn) {
  const cli::testing::TemporaryFolder folder;
  const RunningServer server(folder.path(""), [](ServerOptions& options) { options.max_clients = 2; });
  const test::Stream stream = make_live_stream(3);
  const std::vector<std::size_t> borders = gop_borders(stream);
  Upload upload(server, "/live/cam");
  upload.send(text_of(stream, 0, borders[1]));
  std::unique_ptr<Viewer> viewer;
  ASSERT_TRUE(eventually([&] {  // until the upload is there, a viewer is told that nothing is live
    viewer = std::make_unique<Viewer>(server, "/live/cam");
    return eventually([&] { return !viewer->received().empty(); }) && viewer->received()[0] != 'c';
  }));
  for (int i = 0; i < 12; ++i) {  // more than there are spare threads
    auto answer = server.client().Get("/live/");
    ASSERT_TRUE(answer) << i;
    EXPECT_EQ(answer->status, 503) << i;
    EXPECT_TRUE(answer->has_header("Retry-After")) << i;
  }
  upload.send(text_of(stream, borders[1], stream.size()));
  upload.finish();
  EXPECT_EQ(upload.status(), 200);
  viewer->wait();
  EXPECT_EQ(decode_text(viewer->received()).frames.size(), 6U);
  EXPECT_TRUE(eventually([&] {
    auto answer = server.client().Get("/live/");
    return answer && answer->status == 200;
  }));
}

TEST(LiveLimits, AViewerThatDoesNotReadIsCutOffAndTheOthersLoseNothing) {
  const cli::testing::TemporaryFolder folder;
  constexpr std::size_t kIdle = 8;
  const std::string idle_address = "127.0.0.2";
  const std::string request = "GET /live/cam HTTP/1.1\r\nHost: x\r\n\r\n";
  StoppedClock clock;
  const RunningServer server(folder.path(""), [&](ServerOptions& options) {
    options.now = clock;
    options.max_per_address = kIdle;
  });
  std::mt19937 random(3);
  const Sequence sequence = test::random_sequence(test::grid(100, 80), 24, random);
  EncodeOptions encode_options;
  encode_options.gop_frames = 2;
  encode_options.fine_bits = encode_options.coarse_bits = 20;
  const test::Stream stream = test::encode_sequence(sequence, encode_options);
  const std::vector<std::size_t> borders = gop_borders(stream);
  const auto viewers = [&] {
    auto list = server.client().Get("/live/");
    const nlohmann::json streams =
        list && list->status == 200 ? nlohmann::json::parse(list->body)["streams"] : nlohmann::json::array();
    return streams.empty() ? std::size_t{0} : streams[0]["viewers"].get<std::size_t>();
  };
  // Whether so many more can come at a time from where the idle ones are.
  const auto has_room_for = [&](std::size_t count) {
    std::deque<RawClient> others;  // who was answered keeps its place
    for (std::size_t i = 0; i < count; ++i) {
      others.emplace_back(server.port(), idle_address.c_str()).send("HEAD / HTTP/1.1\r\nHost: x\r\n\r\n");
      if (!others.back().head().starts_with("HTTP/1.1 200 ")) return false;
    }
    return true;
  };

  Upload upload(server, "/live/cam");
  upload.send(text_of(stream, 0, borders[1]));
  ASSERT_TRUE(eventually([&] {
    auto head = server.client().Head("/live/cam");
    return head && head->status == 200;
  }));
  std::deque<RawClient> idle;
  for (std::size_t i = 0; i < kIdle; ++i) {
    idle.emplace_back(server.port(), idle_address.c_str(), 4096).send(request);
  }
  Viewer reads(server, "/live/cam");
  ASSERT_TRUE(eventually([&] { return viewers() == kIdle + 1; }));
  for (std::size_t gop = 1; gop < 12; ++gop) {  // as fast as the one that reads takes them
    upload.send(text_of(stream, borders[gop], borders[gop + 1]));
    ASSERT_TRUE(eventually([&] { return reads.received().size() >= borders[gop + 1]; }));
  }
  upload.send(text_of(stream, borders.back(), stream.size()));
  upload.finish();
  EXPECT_EQ(upload.status(), 200);
  reads.wait();
  EXPECT_TRUE(reads.whole());
  EXPECT_EQ(decode_text(reads.received()).frames.size(), 24U);

  EXPECT_FALSE(has_room_for(1)) << "those who do not read hold their places";
  ASSERT_TRUE(eventually([&] {
    clock.move_on(ServerOptions().timeout);
    return has_room_for(kIdle);
  }));
  for (RawClient& viewer : idle) {
    EXPECT_EQ(viewer.answer().find("\r\n0\r\n\r\n"), std::string::npos) << "it was cut off";
  }
}

TEST(LiveLimits, AnUploadThatStallsIsCutOffAndFreesItsName) {
  const cli::testing::TemporaryFolder folder;
  std::atomic<bool> begun{false}, cut_off{false};
  StoppedClock clock;
  const RunningServer server(folder.path(""), [&](ServerOptions& options) {
    options.now = clock;
    options.log = [&](const std::string& line) {
      if (line.find("begins") != std::string::npos) begun = true;
      if (line.find("idle for too long") != std::string::npos) cut_off = true;
    };
  });
  const test::Stream stream = make_live_stream(3);
  Upload upload(server, "/live/cam");
  upload.send(text_of(stream, 0, 60));
  ASSERT_TRUE(eventually([&] { return begun.load(); }));
  EXPECT_TRUE(eventually([&] {
    clock.move_on(ServerOptions().timeout);
    return cut_off.load();
  }));
  EXPECT_TRUE(eventually([&] {
    auto list = server.client().Get("/live/");
    return list && list->body.find("\"cam\"") == std::string::npos;
  }));
}

}  // namespace
}  // namespace tvg::server::testing
