#include "server/request_head.hpp"

#include "server_toolbox.hpp"

#include <gmock/gmock.h>

namespace tvg::server::testing {
namespace {

using ::testing::StartsWith;

std::string head(const std::string& request, const std::string& headers) {
  return request + " HTTP/1.1\r\nHost: x\r\n" + headers + "\r\n";
}

TEST(RequestHead, IsRefusedWhereTwoReadersCouldDiffer) {
  const std::string put = "PUT /live/x";
  EXPECT_EQ(refusal_of_head(head("GET /", "")), 0);
  EXPECT_EQ(refusal_of_head(head(put, "Content-Length: 5\r\n")), 0);
  EXPECT_EQ(refusal_of_head(head(put, "Content-Length: 5\r\ncontent-length:5 \r\n")), 0) << "they agree";
  EXPECT_EQ(refusal_of_head(head(put, "Transfer-Encoding: Chunked\r\n")), 0);
  EXPECT_EQ(refusal_of_head("GET / HTTP/1.0\r\n\r\n"), 0) << "HTTP/1.0 knows no host";

  EXPECT_EQ(refusal_of_head(head(put, "")), 411);
  EXPECT_EQ(refusal_of_head(head("POST /live/x", "")), 411);
  for (const char* length : {"", "-1", "+5", "5x", "0x5", "5, 5", "5 5", "99999999999999999999"}) {
    EXPECT_EQ(refusal_of_head(head(put, std::string("Content-Length: ") + length + "\r\n")), 400) << length;
  }
  EXPECT_EQ(refusal_of_head(head(put, "Content-Length: 5\r\nContent-Length: 6\r\n")), 400);
  EXPECT_EQ(refusal_of_head(head(put, "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n")), 400);
  EXPECT_EQ(refusal_of_head(head(put, "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n")), 400);
  for (const char* coding : {"gzip", "gzip, chunked", "identity", "xchunked", ""}) {
    EXPECT_EQ(refusal_of_head(head(put, std::string("Transfer-Encoding: ") + coding + "\r\n")), 501)
        << coding;
  }
}

TEST(RequestHead, IsRefusedWhereALineIsNoHeader) {
  EXPECT_EQ(refusal_of_head("GET / HTTP/1.1\r\nHost : x\r\n\r\n"), 400);
  EXPECT_EQ(refusal_of_head("GET / HTTP/1.1\r\n\r\n"), 400) << "no host";
  EXPECT_EQ(refusal_of_head(head("GET /", "Host: y\r\n")), 400) << "two hosts";
  EXPECT_EQ(refusal_of_head(head("GET /", "no colon\r\n")), 400);
  EXPECT_EQ(refusal_of_head(head("GET /", ": no name\r\n")), 400);
  EXPECT_EQ(refusal_of_head(head("GET /", "X: a\r\n folded\r\n")), 400);
  EXPECT_EQ(refusal_of_head(head("GET /", "X: a\nY: b\r\n")), 400);
  EXPECT_EQ(refusal_of_head(head("GET /", "X: a\rb\r\n")), 400);
  EXPECT_EQ(refusal_of_head(head("GET /", std::string("X: a\0b\r\n", 9))), 400);
  EXPECT_EQ(refusal_of_head("GET / HTTP/1.1\nHost: x\n\n"), 400);
}

TEST(RequestHead, EndsWithItsEmptyLine) {
  EXPECT_EQ(end_of_head("GET / HTTP/1.1\r\nHost: x\r\n\r\nbody\n\n"), 27U);
  EXPECT_EQ(end_of_head("GET / HTTP/1.1\nHost: x\n\nbody"), 24U) << "to be refused, not waited for";
  EXPECT_EQ(end_of_head("GET / HTTP/1.1\r\nHost: x\r\n"), std::string::npos);
  EXPECT_EQ(end_of_head(""), std::string::npos);
}

TEST(RequestHead, KeepsEverythingButTheNameOfTheRange) {
  EXPECT_EQ(head_for_routes(head("GET /", "range: bytes=0-1\r\nIf-Range: a\r\n")),
            head("GET /", std::string(kRangeHeader) + ": bytes=0-1\r\nIf-Range: a\r\n"));
}

TEST(RequestHead, RefusalsReachWhoAsked) {
  const cli::testing::TemporaryFolder folder;
  const RunningServer server(folder.path(""));
  const auto status = [&](const std::string& request) {
    RawClient client(server.port());
    client.send(request);
    return client.answer().substr(9, 3);  // the connection ends by itself
  };
  EXPECT_EQ(status(head("PUT /live/x", "")), "411");
  EXPECT_EQ(status(head("PUT /live/x", "Content-Length: many\r\n")), "400");
  EXPECT_EQ(status(head("PUT /live/x", "Content-Length: 5\r\nContent-Length: 6\r\n") + "12345"), "400");
  EXPECT_EQ(status(head("PUT /live/x", "Transfer-Encoding: gzip\r\n")), "501");
  EXPECT_EQ(status("GET / HTTP/1.1\r\nHost : x\r\n\r\n"), "400");
  EXPECT_EQ(status(head("PUT /live/.x", "Content-Length: 5\r\n") + "12345"), "400");
  EXPECT_EQ(status("GET / HTTP/1.1\r\nHost: x\r\nX: " + std::string(kMostHeadBytes, 'a')), "431");
}

}  // namespace
}  // namespace tvg::server::testing
