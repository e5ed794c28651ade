#include "server_toolbox.hpp"

#include <gmock/gmock.h>

namespace tvg::server::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// What a browser gets, which asks for pages where others take JSON.
class Pages : public ::testing::Test {
 protected:
  Pages() {
    const test::Stream stream = make_live_stream(5);
    folder_.write("walk.tvg", text_of(stream, 0, stream.size()));
    folder_.write("sub/a<b>&\"'#?%.tvg", text_of(stream, 0, stream.size()));
    folder_.write("sub/ladder.json", "{}");
    folder_.write("site/index.html", "<p>mine");
    folder_.write("notes & more.txt", "");
    player_.write(
        "index.html",
        "<link rel=\"stylesheet\" href=\"player.css\">\n<main id=\"player\" data-stream=\"clip.tvg\">"
        "</main>\n<script src=\"player.js\"></script>\n");
    player_.write("player.js", "play();");
    player_.write("player.css", "");
    player_.write("tvg.wasm", "wasm");
    player_.write("secret.txt", "");
    server_ = std::make_unique<RunningServer>(
        folder_.path(""), [&](ServerOptions& options) { options.player = player_.path(""); });
  }

  static httplib::Response get(const RunningServer& server, const std::string& path,
                               httplib::Headers headers = {{"Accept", "text/html,*/*;q=0.8"}}) {
    const auto answer = server.client().Get(path, headers);
    EXPECT_TRUE(answer) << path;
    return answer ? *answer : httplib::Response();
  }
  httplib::Response get(const std::string& path,
                        httplib::Headers headers = {{"Accept", "text/html,*/*;q=0.8"}}) const {
    return get(*server_, path, std::move(headers));
  }

  cli::testing::TemporaryFolder folder_, player_;
  std::unique_ptr<RunningServer> server_;
};

TEST_F(Pages, TheStartPageLeadsToThePlayerForEachStream) {
  const httplib::Response page = get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_THAT(page.get_header_value("Content-Security-Policy"), HasSubstr("default-src 'none'"));
  EXPECT_THAT(page.body, HasSubstr("<a href=\"/?stream=walk.tvg\">walk.tvg</a>"));
  EXPECT_THAT(page.body, HasSubstr("Nothing is live"));
  EXPECT_THAT(page.body, HasSubstr("<a href=\"/sub/\">sub</a>"));
  EXPECT_THAT(page.body, HasSubstr("notes &amp; more.txt"));
  EXPECT_EQ(get("/.tvg/").body, page.body);
}

TEST_F(Pages, NamesOfAnyKindAreText) {
  const httplib::Response page = get("/sub/");
  EXPECT_THAT(page.body, HasSubstr("a&lt;b&gt;&amp;&quot;&#39;#?%.tvg"));
  EXPECT_THAT(page.body, Not(HasSubstr("<b>")));
  // The parameter is a URL: decoded once, it still leads to the file.
  EXPECT_THAT(page.body, HasSubstr("/?stream=sub/a%253Cb%253E%2526%2522%2527%2523%253F%2525.tvg"));
  EXPECT_EQ(get("/sub/a%3Cb%3E%26%22%27%23%3F%25.tvg").status, 200);
  EXPECT_THAT(page.body, HasSubstr("/?stream=sub/ladder.json"));
  EXPECT_THAT(page.body, Not(HasSubstr("<h2>Live")));
}

TEST_F(Pages, OthersStillGetJson) {
  for (const httplib::Headers& headers : {httplib::Headers{}, httplib::Headers{{"Accept", "*/*"}}}) {
    EXPECT_EQ(get("/", headers).get_header_value("Content-Type"), "application/json");
    EXPECT_EQ(get("/site/", headers).get_header_value("Vary"), "Accept");
  }
}

TEST_F(Pages, AFoldersOwnPageComesFirst) {
  EXPECT_EQ(get("/site/").body, "<p>mine");
  const httplib::Response moved = get("/site");
  EXPECT_EQ(moved.status, 307);
  EXPECT_EQ(moved.get_header_value("Location"), "/site/");
  EXPECT_EQ(get("//sub").get_header_value("Location"), "/sub/");
  folder_.write("index.html", "<p>root");
  EXPECT_EQ(get("/").body, "<p>root");
  EXPECT_THAT(get("/.tvg/").body, HasSubstr("walk.tvg"));
  EXPECT_THAT(get("/?stream=walk.tvg").body, HasSubstr("id=\"player\""));
}

TEST_F(Pages, ThePlayersPageFindsItsFilesWhereNoFileOfTheFolderCanBe) {
  folder_.write(".tvg/player.js", "not this");
  for (const char* path : {"/?stream=walk.tvg", "/?live=cam", "/?stream=%3Cscript%3E"}) {
    const httplib::Response page = get(path);
    EXPECT_EQ(page.status, 200);
    EXPECT_THAT(page.body, HasSubstr("<main id=\"player\">")) << path;
    EXPECT_THAT(page.body, HasSubstr("src=\"/.tvg/player.js\""));
    EXPECT_THAT(page.body, HasSubstr("href=\"/.tvg/player.css\""));
    EXPECT_THAT(page.get_header_value("Content-Security-Policy"), HasSubstr("script-src 'self'"));
  }
  const httplib::Response script = get("/.tvg/player.js");
  EXPECT_EQ(script.body, "play();");
  EXPECT_EQ(script.get_header_value("Content-Type"), "text/javascript; charset=utf-8");
  EXPECT_EQ(get("/.tvg/tvg.wasm").get_header_value("Content-Type"), "application/wasm");
  for (const char* path :
       {"/.tvg/secret.txt", "/.tvg/index.html", "/.tvg/../walk.tvg", "/.tvg/player.js/", "/.tvg"})
    EXPECT_EQ(get(path).status, 404) << path;
}

TEST_F(Pages, WhatTheClientHasIsNotSentAgain) {
  for (const char* path : {"/", "/?stream=walk.tvg", "/.tvg/player.js"}) {
    const httplib::Response first = get(path);
    const std::string etag = first.get_header_value("ETag");
    EXPECT_THAT(etag, StartsWith("\"")) << path;
    EXPECT_EQ(first.get_header_value("Cache-Control"), "no-cache") << path;
    EXPECT_EQ(get(path, {{"Accept", "text/html"}, {"If-None-Match", etag}}).status, 304) << path;
    EXPECT_EQ(get(path, {{"Accept", "text/html"}, {"If-None-Match", "\"other\""}}).status, 200) << path;
    const auto head = server_->client().Head(path, {{"Accept", "text/html"}});
    ASSERT_TRUE(head) << path;
    EXPECT_EQ(head->status, 200) << path;
    EXPECT_EQ(head->get_header_value("ETag"), etag) << path;
    EXPECT_EQ(head->get_header_value("Content-Length"), std::to_string(first.body.size())) << path;
  }
}

TEST_F(Pages, WhatIsLiveIsThere) {
  const test::Stream stream = make_live_stream(5);
  Upload upload(*server_, "/live/cam");
  upload.send(text_of(stream, 0, gop_borders(stream)[1]));
  EXPECT_TRUE(
      eventually([&] { return get("/").body.find("<a href=\"/?live=cam\">cam</a>") != std::string::npos; }));
  upload.break_off();
}

TEST_F(Pages, WithoutAPlayerStreamsLeadToTheirFilesAndThePageSaysWhy) {
  const RunningServer bare(folder_.path(""));
  const httplib::Response page = get(bare, "/");
  EXPECT_THAT(page.body, HasSubstr("<a href=\"/walk.tvg\">walk.tvg</a>"));
  EXPECT_THAT(page.body, HasSubstr("npm ci"));
  EXPECT_EQ(get(bare, "/?stream=walk.tvg").body, page.body);
  EXPECT_EQ(get(bare, "/.tvg/player.js").status, 404);
}

TEST_F(Pages, APlayerThatIsNoneIsRefusedAtOnce) {
  player_.write("index.html", "<p>");
  const auto start = [&] {
    RunningServer(folder_.path(""), [&](ServerOptions& options) { options.player = player_.path(""); });
  };
  EXPECT_THROW(start(), cli::ToolError);
}

}  // namespace
}  // namespace tvg::server::testing
