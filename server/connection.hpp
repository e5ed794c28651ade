#pragma once
#include <array>
#include <atomic>
#include <chrono>
#include <httplib.h>
#include <string>

namespace tvg::cli {

/// An accepted socket with limits on what its peer may take: a request's head must be in within the time
/// limit and kMostHeadBytes, a body's next byte within the time limit of the last, and whatever is written at
/// once must be taken within it. When `stopping` becomes true, nothing is waited for any more. Owns the
/// socket.
class Connection final : public httplib::Stream {
 public:
  static constexpr std::size_t kMostHeadBytes = std::size_t{1} << 15;

  Connection(socket_t socket, std::chrono::milliseconds time_limit, const std::atomic<bool>& stopping);
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Waits for the next request's first byte; false when there will be none. Limits of a head hold from here.
  bool begin_request(std::chrono::milliseconds time);
  /// The head is in: what follows is a body.
  void end_head() { in_head_ = false; }
  /// Says that nothing more will be written, and takes what the peer still sends for a moment: closing with
  /// bytes unread would destroy what it has not read yet of the answer.
  void close_gently();

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

  bool wait_for(short events, Clock::time_point deadline) const;
  bool fill(Clock::time_point deadline);

  socket_t socket_;
  std::chrono::milliseconds time_limit_;
  const std::atomic<bool>& stopping_;
  bool in_head_ = true;
  Clock::time_point head_deadline_{};
  std::size_t head_bytes_ = 0;
  std::array<char, std::size_t{1} << 14> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace tvg::cli
