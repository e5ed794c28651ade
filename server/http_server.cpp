#include "server/http_server.hpp"

#include "server/request_head.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <string_view>
#include <sys/socket.h>
#include <utility>

namespace tvg::server {

namespace {

constexpr int kRequestsPerConnection = 100;
constexpr std::chrono::milliseconds kKeepAlive{5000};
constexpr std::chrono::milliseconds kKeepAliveInCrowd{1000};
constexpr std::chrono::milliseconds kLook{200};  // between looks at whether it has become crowded

/// Runs what httplib gives it at once, on the thread that accepts: whether there is a place is settled there.
class AtTheDoor final : public httplib::TaskQueue {
 public:
  explicit AtTheDoor(std::shared_ptr<httplib::ThreadPool> threads) : threads_(std::move(threads)) {}

  void enqueue(std::function<void()> task) override { task(); }
  void shutdown() override { threads_->shutdown(); }

 private:
  std::shared_ptr<httplib::ThreadPool> threads_;
};

/// A whole answer for those who do not get as far as a route.
std::string plain_answer(std::string_view status, std::string_view text) {
  return fmt::format(
      "HTTP/1.1 {}\r\n{}Connection: close\r\nAccess-Control-Allow-Origin: *\r\n"
      "Content-Type: text/plain; charset=utf-8\r\nContent-Length: {}\r\n\r\n{}",
      status, status.starts_with("503") ? "Retry-After: 5\r\n" : "", text.size(), text);
}

std::string refusal_answer(int status) {
  switch (status) {
    case 408:
      return plain_answer("408 Request Timeout", "the request did not come in time\n");
    case 411:
      return plain_answer("411 Length Required", "an upload says its length or comes in chunks\n");
    case 431:
      return plain_answer("431 Request Header Fields Too Large", "the request's head is too long\n");
    case 501:
      return plain_answer("501 Not Implemented", "the only transfer coding known here is chunked\n");
    default:
      return plain_answer("400 Bad Request", "the request is not understood\n");
  }
}

bool has_body(const httplib::Request& request) {
  return (request.method != "GET" && request.method != "HEAD" && request.method != "OPTIONS") ||
         request.has_header("Content-Length") || request.has_header("Transfer-Encoding");
}

/// The head of the next request, or the status to refuse it with; -1 where there is nobody to answer.
int take_head(Connection& connection, std::string& head) {
  switch (connection.take_head(head)) {
    case Connection::Head::kWhole:
      return refusal_of_head(head);
    case Connection::Head::kTooLong:
      return 431;
    case Connection::Head::kTooSlow:
      return 408;
    case Connection::Head::kCut:
      break;
  }
  return -1;
}

}  // namespace

HttpServer::HttpServer(std::size_t max_clients, std::size_t max_per_address, TimeLimit limit)
    : limit_(std::move(limit)), admission_(max_clients, max_per_address) {
  new_task_queue = [this, max_clients] {
    threads_ = std::make_shared<httplib::ThreadPool>(max_clients);
    return new AtTheDoor(threads_);
  };
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
  std::shared_ptr<Admission::Place> place = admission_.enter(address_of_peer(socket));
  if (place != nullptr) {
    threads_->enqueue([this, socket, place = std::move(place)]() mutable {
      serve(socket);
      place.reset();
    });
    return true;
  }
  static const std::string answer = plain_answer(
      "503 Service Unavailable", "too many clients at once, or too many from there: try again soon\n");
  // It fits an empty send buffer, and nothing is waited for.
  ::send(socket, answer.data(), answer.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  farewell_.take(socket);
  return false;
}

void HttpServer::serve(socket_t socket) {
  Connection connection(socket, limit_, stopping_);
  for (int left = kRequestsPerConnection; left > 0 && await_request(connection); --left) {
    if (!answer_request(connection, left == 1) || stopping_) break;
  }
  farewell_.take(connection.release());
}

/// Waits for a request's first byte, and less long where others find no place.
bool HttpServer::await_request(Connection& connection) const {
  std::chrono::milliseconds waited{0};
  while (waited < (admission_.crowded() ? kKeepAliveInCrowd : kKeepAlive)) {
    const Connection::Await come = connection.await_request(kLook);
    if (come != Connection::Await::kNothingYet) return come == Connection::Await::kThere;
    waited += kLook;
  }
  return false;
}

/// False where no further request may follow on the connection.
bool HttpServer::answer_request(Connection& connection, bool last) {
  std::string head;
  const int refusal = take_head(connection, head);
  if (refusal > 0) {
    const std::string answer = refusal_answer(refusal);
    connection.write(answer.data(), answer.size());
  }
  if (refusal != 0) return false;
  connection.put_back(head_for_routes(head));
  bool closed_by_client = false;
  bool body = false;
  const bool answered = process_request(connection, last, closed_by_client, [&](httplib::Request& request) {
    body = has_body(request);
    request.headers.erase("Accept-Encoding");  // streams are compressed already
    if (!body) return;
    // A body may not have been read to its end, and must not be taken for a request.
    request.headers.erase("Connection");
    request.set_header("Connection", "close");
  });
  return answered && !closed_by_client && !body;
}

}  // namespace tvg::server
