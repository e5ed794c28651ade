#pragma once
#include "server/admission.hpp"
#include "server/connection.hpp"
#include "server/farewell.hpp"

#include <atomic>
#include <cstddef>
#include <httplib.h>
#include <memory>
#include <string>

namespace tvg::server {

/// httplib's server with this tool's limits on connections: their number, altogether and from one address,
/// the time and bytes a head may take, what a head may say, and no body but where a handler reads it. Who
/// finds no place is told so at once, by the thread that accepts.
class HttpServer final : public httplib::Server {
 public:
  HttpServer(std::size_t max_clients, std::size_t max_per_address, TimeLimit limit);

  /// Makes room for many viewers that come at the same moment; after binding.
  void widen_backlog();
  /// Lets every wait for a client fail at once.
  void abandon_clients() { stopping_ = true; }
  bool abandoning() const { return stopping_; }

 private:
  bool process_and_close_socket(socket_t socket) override;
  void serve(socket_t socket);
  bool await_request(Connection& connection) const;
  bool answer_request(Connection& connection, bool last);

  const TimeLimit limit_;
  Admission admission_;
  Farewell farewell_;
  std::shared_ptr<httplib::ThreadPool> threads_;  ///< one for each place, while it listens
  std::atomic<bool> stopping_{false};
};

}  // namespace tvg::server
