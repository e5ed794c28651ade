#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <httplib.h>
#include <mutex>
#include <thread>

namespace tvg::server {

/// Closes connections that were turned away: for a moment it takes what their peers still send, because
/// closing with bytes unread would destroy the answer before it is read. One thread for all of them, so that
/// whoever turns them away waits for nobody.
class Farewell {
 public:
  /// Most sockets held; more than these are closed at once.
  static constexpr std::size_t kMost = 256;

  Farewell() : thread_([this] { run(); }) {}
  ~Farewell();
  Farewell(const Farewell&) = delete;
  Farewell& operator=(const Farewell&) = delete;

  /// Takes over a socket on which all has been written.
  void take(socket_t socket);

 private:
  using Clock = std::chrono::steady_clock;
  struct Leaving {
    socket_t socket;
    Clock::time_point deadline;
  };

  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Leaving> arrived_;
  std::atomic<std::size_t> held_{0};
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace tvg::server
