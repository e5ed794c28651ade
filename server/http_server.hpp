#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <httplib.h>

namespace tvg::cli {

/// httplib's server with this tool's limits on connections: their number, the time and bytes a head may take,
/// and no body but where a handler reads it.
class HttpServer final : public httplib::Server {
 public:
  HttpServer(std::size_t max_clients, std::chrono::milliseconds timeout);

  /// Makes room for many viewers that come at the same moment; after binding.
  void widen_backlog();
  /// Lets every wait for a client fail at once.
  void abandon_clients() { stopping_ = true; }
  bool abandoning() const { return stopping_; }

 private:
  bool process_and_close_socket(socket_t socket) override;

  const std::size_t max_clients_;
  const std::chrono::milliseconds timeout_;
  std::atomic<std::size_t> clients_{0};
  std::atomic<bool> stopping_{false};
};

}  // namespace tvg::cli
