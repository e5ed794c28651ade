#include "server_toolbox.hpp"

#include <gmock/gmock.h>

namespace tvg::server::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A server whose places are taken one after the other by uploads that go on.
class House : public ::testing::Test {
 protected:
  void open(std::size_t places, std::size_t per_address) {
    server_ = std::make_unique<RunningServer>(folder_.path(""), [&](ServerOptions& options) {
      options.max_clients = places;
      options.max_per_address = per_address;
      options.log = [this](const std::string& line) {
        if (line.find("begins") != std::string::npos) ++begun_;
      };
    });
  }
  void take_place() {
    const std::size_t number = uploads_.size() + 1;
    uploads_.push_back(std::make_unique<Upload>(*server_, "/live/" + std::to_string(number)));
    uploads_.back()->send(text_of(stream_, 0, 50));
    EXPECT_TRUE(eventually([&] { return begun_ >= number; }));
  }

  cli::testing::TemporaryFolder folder_;
  test::Stream stream_ = make_live_stream(3);
  std::atomic<std::size_t> begun_{0};
  std::unique_ptr<RunningServer> server_;
  std::vector<std::unique_ptr<Upload>> uploads_;
};

const std::string kRequest = "GET /live/ HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n";

TEST_F(House, WhenFullSaysSoToEveryoneWithoutWaitingForARequest) {
  open(2, 2);
  take_place();
  take_place();
  // None of them sends anything or leaves before all were answered; one asks after it was answered.
  std::vector<std::unique_ptr<RawClient>> crowd;
  for (int i = 0; i < 200; ++i) crowd.push_back(std::make_unique<RawClient>(server_->port()));
  for (const auto& one : crowd) {
    const std::string answer = one->answer();
    ASSERT_THAT(answer, StartsWith("HTTP/1.1 503 "));
    ASSERT_THAT(answer, HasSubstr("Retry-After: "));
    ASSERT_THAT(answer, HasSubstr("too many"));
  }
  crowd.front()->send(kRequest);
}

TEST_F(House, LetsInOnlySoManyFromOneAddress) {
  open(10, 2);
  take_place();
  take_place();
  RawClient third(server_->port());
  EXPECT_THAT(third.answer(), StartsWith("HTTP/1.1 503 "));
  RawClient other(server_->port(), "127.0.0.2");
  other.send(kRequest);
  EXPECT_THAT(other.answer(), StartsWith("HTTP/1.1 200 "));
  uploads_.pop_back();
  EXPECT_TRUE(eventually([&] {
    auto answer = server_->client().Get("/live/");
    return answer && answer->status == 200;
  })) << "a place that is given back is free";
}

TEST_F(House, IsNotHeldByThoseWhoAskForNothing) {
  open(1, 1);
  RawClient silent(server_->port());
  EXPECT_TRUE(eventually([&] {
    auto answer = server_->client().Get("/live/");
    return answer && answer->status == 200;
  }));
  EXPECT_EQ(silent.answer(), "") << "it was closed";
}

TEST_F(House, IsNotHeldByASlowHead) {
  server_ = std::make_unique<RunningServer>(folder_.path(""), [](ServerOptions& options) {
    options.timeout = std::chrono::milliseconds(150);
    options.max_clients = 1;
  });
  RawClient slow(server_->port());
  slow.send("GET / HT");
  EXPECT_THAT(slow.answer(), StartsWith("HTTP/1.1 408 "));
  EXPECT_TRUE(eventually([&] {
    auto answer = server_->client().Get("/live/");
    return answer && answer->status == 200;
  }));
}

}  // namespace
}  // namespace tvg::server::testing
