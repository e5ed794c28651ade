#include "server/http_server.hpp"

#include "server/connection.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <string_view>
#include <sys/socket.h>

namespace tvg::cli {

namespace {

constexpr std::size_t kSpareThreads = 8;  // answer 503 while all clients' threads are taken
constexpr int kRequestsPerConnection = 100;
constexpr std::chrono::milliseconds kKeepAlive{5000};

constexpr std::string_view kTooManyClients =
    "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 5\r\nConnection: close\r\n"
    "Access-Control-Allow-Origin: *\r\nContent-Type: text/plain\r\nContent-Length: 41\r\n\r\n"
    "too many clients at once: try again soon\n";

/// Counts for as long as it lives.
class Counted {
 public:
  explicit Counted(std::atomic<std::size_t>& count) : count_(count), number_(++count) {}
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

  std::size_t number() const { return number_; }

 private:
  std::atomic<std::size_t>& count_;
  std::size_t number_;
};

/// What httplib should not see or do.
void prepare(httplib::Request& request) {
  request.headers.erase("Accept-Encoding");  // streams are compressed already
  request.ranges.clear();                    // it would cut error texts too; file_response.hpp has its own
}

bool has_body(const httplib::Request& request) {
  return (request.method != "GET" && request.method != "HEAD" && request.method != "OPTIONS") ||
         request.has_header("Content-Length") || request.has_header("Transfer-Encoding");
}

}  // namespace

HttpServer::HttpServer(std::size_t max_clients, std::chrono::milliseconds timeout)
    : max_clients_(max_clients), timeout_(timeout) {
  new_task_queue = [max_clients] { return new httplib::ThreadPool(max_clients + kSpareThreads); };
  set_keep_alive_max_count(kRequestsPerConnection);  // what answers promise
  set_keep_alive_timeout(kKeepAlive.count() / 1000);
  set_socket_options([](socket_t socket) {
    // Not SO_REUSEPORT, httplib's choice: a second server would share the port instead of being refused.
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  });
}

void HttpServer::widen_backlog() {
  ::listen(svr_sock_, SOMAXCONN);
}

bool HttpServer::process_and_close_socket(socket_t socket) {
  Connection connection(socket, timeout_, stopping_);
  const Counted client(clients_);
  if (client.number() > max_clients_) {
    connection.write(kTooManyClients.data(), kTooManyClients.size());
    connection.close_gently();
    return false;
  }
  bool go_on = true;
  for (int left = kRequestsPerConnection; go_on && left > 0 && connection.begin_request(kKeepAlive); --left) {
    bool closed_by_client = false;
    bool body = false;
    const bool answered =
        process_request(connection, left == 1, closed_by_client, [&](httplib::Request& request) {
          connection.end_head();
          body = has_body(request);
          prepare(request);
          if (!body) return;
          // A body may not have been read to its end, and must not be taken for a request.
          request.headers.erase("Connection");
          request.set_header("Connection", "close");
        });
    go_on = answered && !closed_by_client && !body && !stopping_;
  }
  connection.close_gently();
  return true;
}

}  // namespace tvg::cli
