#include "nginx.hpp"
#include "server/file_response.hpp"
#include "server_toolbox.hpp"
#include "tests/playback/playback_toolbox.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace tvg::server::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// What a player relies on, of this project's server and of one that knows nothing of TVG.
class Files : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const test::Stream stream = make_live_stream(5);
    content_ = text_of(stream, 0, stream.size());
    folder_.write("walk.tvg", content_);
    folder_.write("sub/empty.tvg", "");
    if (std::string(GetParam()) == "nginx") {
      const std::optional<std::string> program = find_nginx();
      if (!program) GTEST_SKIP() << "nginx is not installed";
      nginx_ = std::make_unique<Nginx>(*program, folder_.path(""));
      ASSERT_TRUE(nginx_->running());
      port_ = nginx_->port();
    } else {
      own_ = std::make_unique<RunningServer>(folder_.path(""));
      port_ = own_->port();
    }
  }

  httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) const {
    return httplib::Client("127.0.0.1", port_).Get(path, headers);
  }
  httplib::Response whole() const {
    auto answer = get("/walk.tvg");
    EXPECT_TRUE(answer);
    return answer ? *answer : httplib::Response();
  }
  void expect_range(const std::string& range, std::size_t begin, std::size_t end,
                    httplib::Headers headers = {}) const {
    headers.emplace("Range", range);
    auto answer = get("/walk.tvg", headers);
    ASSERT_TRUE(answer) << range;
    EXPECT_EQ(answer->status, 206) << range;
    EXPECT_EQ(answer->body, content_.substr(begin, end - begin)) << range;
    EXPECT_EQ(answer->get_header_value("Content-Range"), "bytes " + std::to_string(begin) + "-" +
                                                             std::to_string(end - 1) + "/" +
                                                             std::to_string(content_.size()));
    EXPECT_EQ(answer->get_header_value("Content-Length"), std::to_string(end - begin));
  }

  cli::testing::TemporaryFolder folder_;
  std::string content_;
  std::unique_ptr<Nginx> nginx_;
  std::unique_ptr<RunningServer> own_;
  int port_ = 0;
};

TEST_P(Files, AWholeFileComesWithWhatIsNeededToGoOnLater) {
  const httplib::Response answer = whole();
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, content_);
  EXPECT_EQ(answer.get_header_value("Accept-Ranges"), "bytes");
  EXPECT_EQ(answer.get_header_value("Content-Length"), std::to_string(content_.size()));
  EXPECT_EQ(answer.get_header_value("Content-Type"), "model/vnd.tvg");
  EXPECT_THAT(answer.get_header_value("ETag"), ::testing::StartsWith("\""));
  EXPECT_THAT(answer.get_header_value("Last-Modified"), HasSubstr("GMT"));
}

TEST_P(Files, HeadSaysTheSameWithoutABody) {
  auto answer = httplib::Client("127.0.0.1", port_).Head("/walk.tvg");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Content-Length"), std::to_string(content_.size()));
  EXPECT_EQ(answer->get_header_value("ETag"), whole().get_header_value("ETag"));
  EXPECT_TRUE(answer->body.empty());
}

TEST_P(Files, RangesGiveTheBytesAskedFor) {
  const std::size_t size = content_.size();
  expect_range("bytes=0-7", 0, 8);
  expect_range("bytes=100-199", 100, 200);
  expect_range("bytes=100-", 100, size);
  expect_range("bytes=-28", size - 28, size);
  expect_range("bytes=" + std::to_string(size - 1) + "-", size - 1, size);
  expect_range("bytes=100-99999999", 100, size);
  expect_range("bytes=-99999999", 0, size);
}

TEST_P(Files, ARangeBehindTheEndIs416WithTheSize) {
  for (const std::string& range :
       {"bytes=" + std::to_string(content_.size()) + "-", std::string("bytes=99999999-999999999")}) {
    auto answer = get("/walk.tvg", {{"Range", range}});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 416) << range;
    EXPECT_EQ(answer->get_header_value("Content-Range"), "bytes */" + std::to_string(content_.size()));
  }
}

TEST_P(Files, IfRangeGivesTheRangeOfTheSameFileAndTheWholeOfAnother) {
  const httplib::Response known = whole();
  expect_range("bytes=10-19", 10, 20, {{"If-Range", known.get_header_value("ETag")}});
  expect_range("bytes=10-19", 10, 20, {{"If-Range", known.get_header_value("Last-Modified")}});
  for (const char* other : {"\"another\"", "Wed, 21 Oct 2015 07:28:00 GMT"}) {
    auto answer = get("/walk.tvg", {{"Range", "bytes=10-19"}, {"If-Range", other}});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 200) << other;
    EXPECT_EQ(answer->body, content_) << other;
  }
}

TEST_P(Files, AChangedFileHasAnotherTag) {
  const std::string before = whole().get_header_value("ETag");
  folder_.write("walk.tvg", content_ + "more");
  EXPECT_NE(whole().get_header_value("ETag"), before);
}

TEST_P(Files, WhatHasNotChangedIsNotSentAgain) {
  const httplib::Response known = whole();
  for (const auto& [name, value] : {std::pair("If-None-Match", known.get_header_value("ETag")),
                                    {"If-None-Match", "\"another\", " + known.get_header_value("ETag")},
                                    {"If-Modified-Since", known.get_header_value("Last-Modified")}}) {
    auto answer = get("/walk.tvg", {{name, value}});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 304) << name << ": " << value;
    EXPECT_TRUE(answer->body.empty());
  }
  auto other = get("/walk.tvg", {{"If-None-Match", "\"another\""}});
  ASSERT_TRUE(other);
  EXPECT_EQ(other->status, 200);
}

TEST_P(Files, SeveralRangesAreInTheAnswer) {
  auto answer = get("/walk.tvg", {{"Range", "bytes=0-7, 100-119"}});
  ASSERT_TRUE(answer);
  EXPECT_THAT(answer->status, ::testing::AnyOf(200, 206)) << "as one whole, or in parts";
  EXPECT_THAT(answer->body, HasSubstr(content_.substr(0, 8)));
  EXPECT_THAT(answer->body, HasSubstr(content_.substr(100, 20)));
}

TEST_P(Files, AnEmptyFileIsEmptyAndHasNoRanges) {
  auto answer = get("/sub/empty.tvg");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_TRUE(answer->body.empty());
}

TEST_P(Files, WhatIsNotThereIs404) {
  auto answer = get("/gone.tvg");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 404);
}

TEST_P(Files, PlayAndSeekAsFromADisk) {
  const test::Stream stream = make_live_stream(12);
  folder_.write("clip.tvg", std::string(stream.begin(), stream.end()));
  const test::DecodedStream expected = test::decode_stream(stream);
  player::StreamLoader loader(
      player::open_stream_input("http://127.0.0.1:" + std::to_string(port_) + "/clip.tvg"));
  for (const std::uint64_t frame : {0u, 1u, 2u, 19u, 20u, 6u, 23u}) {
    if (!loader.heads_for(frame)) loader.seek(frame);
    ASSERT_NO_FATAL_FAILURE(test::expect_frame(loader, expected.frames[frame])) << frame;
  }
  EXPECT_EQ(loader.snapshot().frame_count, 24u);
}

INSTANTIATE_TEST_SUITE_P(ServedBy, Files, ::testing::Values("tvg", "nginx"),
                         [](const auto& test) { return std::string(test.param); });

class Folder : public ::testing::Test {
 protected:
  Folder() {
    const test::Stream stream = make_live_stream(5);
    folder_.write("in/walk.tvg", text_of(stream, 0, stream.size()));
    folder_.write("in/a b%.txt", "text");
    folder_.write("in/.secret", "hidden");
    folder_.write("in/.git/config", "hidden");
    folder_.write("in/sub/deep.tvg", "no stream");
    folder_.write("out/passwords", "hidden");
    std::filesystem::create_symlink("../out/passwords", folder_.path("in/link"));
    std::filesystem::create_directory_symlink("../out", folder_.path("in/outside"));
    std::filesystem::create_symlink(".secret", folder_.path("in/innocent"));
    std::filesystem::create_symlink("walk.tvg", folder_.path("in/newest.tvg"));
    server_ = std::make_unique<RunningServer>(folder_.path("in"));
  }

  httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) const {
    return server_->client().Get(path, headers);
  }
  /// The answer to bytes that no client library would send.
  std::string raw(const std::string& request) const {
    RawClient client(server_->port());
    client.send(request);
    client.end();
    return client.answer();
  }

  cli::testing::TemporaryFolder folder_;
  std::unique_ptr<RunningServer> server_;
};

TEST_F(Folder, NothingOutsideAndNothingHiddenIsServed) {
  for (const char* path : {"/../out/passwords",
                           "/%2e%2e/out/passwords",
                           "/..%2fout/passwords",
                           "/%2e%2e%2fout%2fpasswords",
                           "/sub/../../out/passwords",
                           "/sub/%2e%2e/%2e%2e/out/passwords",
                           "//../out/passwords",
                           "/link",
                           "/outside/passwords",
                           "/outside/",
                           "/outside",
                           "/innocent",
                           "/.secret",
                           "/%2esecret",
                           "/.git/config",
                           "/sub/../.secret",
                           "/..",
                           "/%2e%2e/",
                           "/walk.tvg%00.txt",
                           "/\\..\\out\\passwords"}) {
    const std::string answer =
        raw(std::string("GET ") + path + " HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
    EXPECT_THAT(answer, HasSubstr("HTTP/1.1 404")) << path;
    EXPECT_THAT(answer, Not(HasSubstr("hidden"))) << path;
  }
  auto inside = get("/newest.tvg");
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->status, 200) << "a link that stays inside is followed";
}

TEST_F(Folder, TheListingSaysWhatIsThere) {
  auto answer = get("/");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->get_header_value("Content-Type"), "application/json");
  const nlohmann::json listing = nlohmann::json::parse(answer->body);
  std::map<std::string, nlohmann::json> entries;
  for (const nlohmann::json& entry : listing["entries"]) entries[entry["name"]] = entry;
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries) names.push_back(name);
  EXPECT_THAT(names, ::testing::ElementsAre("a b%.txt", "newest.tvg", "sub", "walk.tvg"));
  EXPECT_EQ(entries["walk.tvg"]["frames"], 10);
  EXPECT_EQ(entries["walk.tvg"]["vertices"], 42);
  EXPECT_EQ(entries["walk.tvg"]["type"], "file");
  EXPECT_EQ(entries["sub"]["type"], "folder");
  EXPECT_EQ(listing["complete"], true);
  for (const auto& [name, entry] : entries) {
    auto linked = get(entry["url"].get<std::string>());
    ASSERT_TRUE(linked);
    EXPECT_EQ(linked->status, 200) << name;
  }
  auto sub = get("/sub/");
  ASSERT_TRUE(sub);
  EXPECT_EQ(nlohmann::json::parse(sub->body)["entries"][0]["url"], "/sub/deep.tvg");
  EXPECT_FALSE(nlohmann::json::parse(sub->body)["entries"][0].contains("frames"));
}

TEST_F(Folder, PagesOfOtherSitesMayReadRanges) {
  auto options = server_->client().Options(
      "/walk.tvg",
      {{"Origin", "https://example.org"}, {"Access-Control-Request-Headers", "range, if-range"}});
  ASSERT_TRUE(options);
  EXPECT_EQ(options->status, 204);
  EXPECT_EQ(options->get_header_value("Access-Control-Allow-Origin"), "*");
  EXPECT_THAT(options->get_header_value("Access-Control-Allow-Headers"), HasSubstr("If-Range"));
  for (const char* path : {"/walk.tvg", "/gone.tvg", "/live/"}) {
    auto answer = get(path);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->get_header_value("Access-Control-Allow-Origin"), "*") << path;
    EXPECT_THAT(answer->get_header_value("Access-Control-Expose-Headers"), HasSubstr("Content-Range"));
  }
}

TEST_F(Folder, BadRequestsGetA4xxAndTheServerGoesOn) {
  const std::string nines(30, '9');
  std::string many = "bytes=0-0";
  while (many.size() < 8000) many += ",0-0";
  const std::string end = "\r\nHost: x\r\n\r\n";
  const std::vector<std::string> requests = {
      std::string("nonsense\r\n\r\n"),
      "GET /walk.tvg HTTP/9.9" + end,
      "BREW /walk.tvg HTTP/1.1" + end,
      "DELETE /walk.tvg HTTP/1.1" + end,
      "GET /" + std::string(3000, 'a') + " HTTP/1.1" + end,
      "GET /" + std::string(100000, 'a') + " HTTP/1.1" + end,
      "POST /walk.tvg HTTP/1.1\r\nContent-Length: 99999999999\r\n" + end.substr(2),
      "GET /walk.tvg HTTP/1.1\r\nX: " + std::string(100000, 'a') + end,
      "PUT /live/x HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nzzzz\r\n",
      "PUT /live/x HTTP/1.1\r\nContent-Type: multipart/form-data; boundary=a\r\nContent-Length: 9\r\n" +
          end.substr(2)};
  for (const std::string& request : requests) {
    const std::string answer = raw(request);
    if (!answer.empty()) {
      EXPECT_THAT(answer, HasSubstr("HTTP/1.1 4")) << request.substr(0, 60);
    }
  }
  const std::vector<std::string> ranges = {"bytes=0-" + nines, many, "bytes=-0", "lines=1-2"};
  for (const std::string& range : ranges) {
    EXPECT_THAT(
        raw("GET /walk.tvg HTTP/1.1\r\nConnection: close\r\nRange: " + range + "\r\n" + end.substr(2)),
        HasSubstr("HTTP/1.1 "))
        << range.substr(0, 60);
  }
  auto answer = get("/walk.tvg");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
}

TEST_F(Folder, WhatIsNoSingleRangeOfBytesGetsTheWhole) {
  const std::string whole = get("/walk.tvg")->body;
  for (const char* range : {"lines=1-2", "bytes=0-7,100-119", "bytes=9-1", "bytes=a-b", "bytes", "none"}) {
    auto answer = get("/walk.tvg", {{"Range", range}});
    ASSERT_TRUE(answer) << range;
    EXPECT_EQ(answer->status, 200) << range;
    EXPECT_EQ(answer->body, whole) << range;
    EXPECT_FALSE(answer->has_header("Content-Range")) << range;
  }
}

TEST(ServerStart, ATakenPortAndAMissingFolderAreToolErrors) {
  const cli::testing::TemporaryFolder folder;
  const RunningServer first(folder.path(""));
  ServerOptions options;
  options.folder = folder.path("");
  options.port = first.port();
  EXPECT_THROW(StreamServer{options}, cli::ToolError);
  options.folder = folder.path("gone");
  options.port = 0;
  EXPECT_THROW(StreamServer{options}, cli::ToolError);
}

TEST(Ranges, AreChosenAsTheRfcSays) {
  const auto choose = [](const std::string& header) {
    const RangeChoice choice = choose_range(header, 100);
    if (choice.unsatisfiable) return std::string("none");
    if (!choice.range) return std::string("whole");
    return std::to_string(choice.range->offset) + "+" + std::to_string(choice.range->size);
  };
  EXPECT_EQ(choose("bytes=0-0"), "0+1");
  EXPECT_EQ(choose("bytes=0-99"), "0+100");
  EXPECT_EQ(choose("bytes=-7"), "93+7");
  EXPECT_EQ(choose("bytes= 5-9 "), "5+5");
  EXPECT_EQ(choose("bytes=-18446744073709551615"), "0+100");
  EXPECT_EQ(choose("bytes=90-18446744073709551615"), "90+10");
  EXPECT_EQ(choose("bytes=100-"), "none");
  EXPECT_EQ(choose("bytes=-0"), "none");
  for (const char* nonsense :
       {"", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=9-5", "bytes=1-2x", "bytes=--5", "bytes=5",
        "bytes=,", "bytes=99999999999999999999-", "lines=1-2", "bytes=5-9,50-"}) {
    EXPECT_EQ(choose(nonsense), "whole") << nonsense;
  }
}

}  // namespace
}  // namespace tvg::server::testing
