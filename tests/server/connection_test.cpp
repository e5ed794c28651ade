#include "server/connection.hpp"

#include <array>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

namespace tvg::server {
namespace {

using Clock = std::chrono::steady_clock;

/// A connection by whose clock an hour passes between two looks at it, and the socket of its peer.
class LateConnection : public ::testing::Test {
 protected:
  LateConnection() { EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, sockets_.data()), 0); }
  ~LateConnection() override { ::close(sockets_[1]); }

  std::array<int, 2> sockets_{};
  Clock::time_point now_{};
  const TimeLimit limit_{std::chrono::seconds(30), [this] { return now_ += std::chrono::hours(1); }};
  const std::atomic<bool> stopping_{false};
};

TEST_F(LateConnection, WhatHasComeCountsHoweverLateItIsLookedAt) {
  Connection connection(sockets_[0], limit_, stopping_);
  ASSERT_EQ(::send(sockets_[1], "GET / HTTP/1.1\r\n\r\n", 18, 0), 18);
  std::string head;
  EXPECT_EQ(connection.take_head(head), Connection::Head::kWhole);
  char byte = 0;
  EXPECT_EQ(connection.read(&byte, 1), -1) << "nothing came";
  ASSERT_EQ(::send(sockets_[1], "x", 1, 0), 1);
  EXPECT_EQ(connection.read(&byte, 1), 1);
}

TEST_F(LateConnection, AWriteThatNobodyTakesFails) {
  Connection connection(sockets_[0], limit_, stopping_);
  const std::string much(std::size_t{1} << 24, 'x');
  EXPECT_EQ(connection.write(much.data(), much.size()), -1);
}

TEST_F(LateConnection, AWriteThatFitsIsTaken) {
  Connection connection(sockets_[0], limit_, stopping_);
  EXPECT_EQ(connection.write("x", 1), 1);
}

}  // namespace
}  // namespace tvg::server
