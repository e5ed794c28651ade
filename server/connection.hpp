#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <httplib.h>
#include <string>
#include <utility>

namespace tvg::server {

/// The address of a socket's peer as text; empty where it has gone.
std::string address_of_peer(socket_t socket);

/// How long a peer may take, and by which clock.
struct TimeLimit {
  std::chrono::milliseconds time;
  std::function<std::chrono::steady_clock::time_point()> now;

  std::chrono::steady_clock::time_point deadline() const { return now() + time; }
};

/// An accepted socket with limits on what its peer may take: a request's head must be in within the time
/// limit and kMostHeadBytes, a body's next byte within the time limit of the last, and whatever is written at
/// once must be taken within it. When `stopping` becomes true, nothing is waited for any more. Owns the
/// socket.
class Connection final : public httplib::Stream {
 public:
  /// `limit` must outlive the connection.
  Connection(socket_t socket, const TimeLimit& limit, const std::atomic<bool>& stopping);
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  enum class Await { kThere, kNothingYet, kGone };
  /// Waits for the next request's first byte.
  Await await_request(std::chrono::milliseconds time);

  enum class Head { kWhole, kTooLong, kTooSlow, kCut };
  /// Takes the head of the request that has begun, up to and with its empty line.
  Head take_head(std::string& head);
  /// What read() gives out before anything else: a head that was taken.
  void put_back(const std::string& head);

  /// Gives the socket away.
  socket_t release() { return std::exchange(socket_, -1); }

  bool is_readable() const override;
  /// Whether bytes can be written now or soon; false when the peer has gone.
  bool is_writable() const override;
  ssize_t read(char* data, std::size_t size) override;
  /// Writes everything or fails.
  ssize_t write(const char* data, std::size_t size) override;
  using httplib::Stream::write;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  enum class Fill { kBytes, kTimeUp, kGone };

  bool wait_for(short events, Clock::time_point deadline) const;
  Fill fill(Clock::time_point deadline);

  socket_t socket_;
  const TimeLimit& limit_;
  const std::atomic<bool>& stopping_;
  std::string received_;  ///< and not given out from begin_ on
  std::size_t begin_ = 0;
};

}  // namespace tvg::server
