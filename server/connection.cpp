#include "server/connection.hpp"

#include "server/request_head.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <string_view>
#include <sys/socket.h>
#include <unistd.h>

namespace tvg::server {

namespace {

constexpr std::chrono::milliseconds kSlice{100};  // how late a wait hears that the server is stopping

void read_address(const sockaddr_storage& address, std::string& ip, int& port) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address.ss_family == AF_INET) {
    sockaddr_in v4{};
    std::memcpy(&v4, &address, sizeof v4);
    inet_ntop(AF_INET, &v4.sin_addr, text.data(), text.size());
    port = ntohs(v4.sin_port);
  } else if (address.ss_family == AF_INET6) {
    sockaddr_in6 v6{};
    std::memcpy(&v6, &address, sizeof v6);
    inet_ntop(AF_INET6, &v6.sin6_addr, text.data(), text.size());
    port = ntohs(v6.sin6_port);
  }
  ip = text.data();
}

}  // namespace

std::string address_of_peer(socket_t socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::string ip;
  int port = 0;
  if (::getpeername(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0)
    read_address(address, ip, port);
  return ip;
}

Connection::Connection(socket_t socket, const TimeLimit& limit, const std::atomic<bool>& stopping)
    : socket_(socket), limit_(limit), stopping_(stopping) {
#ifdef TCP_NOTSENT_LOWAT
  // What a viewer does not take must not queue up in the system by the megabyte: it would never be late
  // enough to skip.
  const int most_unsent = 1 << 17;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &most_unsent, sizeof most_unsent);
#endif
}

Connection::~Connection() {
  if (socket_ >= 0) ::close(socket_);
}

bool Connection::wait_for(short events, Clock::time_point deadline) const {
  while (!stopping_) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - limit_.now());
    const auto slice = std::clamp(left, std::chrono::milliseconds(0), kSlice);
    pollfd entry{socket_, events, 0};
    const int ready = ::poll(&entry, 1, static_cast<int>(slice.count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
    // Only now: what is there counts, however late a busy machine comes to look.
    if (left.count() <= 0) return false;
  }
  return false;
}

Connection::Fill Connection::fill(Clock::time_point deadline) {
  received_.erase(0, begin_);
  begin_ = 0;
  std::array<char, std::size_t{1} << 14> piece;
  for (;;) {
    if (!wait_for(POLLIN, deadline)) return stopping_ ? Fill::kGone : Fill::kTimeUp;
    const ssize_t got = ::recv(socket_, piece.data(), piece.size(), MSG_DONTWAIT);
    if (got > 0) {
      received_.append(piece.data(), static_cast<std::size_t>(got));
      return Fill::kBytes;
    }
    if (got == 0 || (errno != EINTR && errno != EAGAIN && errno != EWOULDBLOCK)) return Fill::kGone;
  }
}

Connection::Await Connection::await_request(std::chrono::milliseconds time) {
  if (begin_ < received_.size()) return Await::kThere;
  switch (fill(limit_.now() + time)) {
    case Fill::kBytes:
      return Await::kThere;
    case Fill::kTimeUp:
      return Await::kNothingYet;
    case Fill::kGone:
      break;
  }
  return Await::kGone;
}

Connection::Head Connection::take_head(std::string& head) {
  const Clock::time_point deadline = limit_.deadline();
  for (;;) {
    const std::string_view there = std::string_view(received_).substr(begin_);
    const std::size_t end = end_of_head(there);
    if (std::min(end, there.size()) > kMostHeadBytes) return Head::kTooLong;
    if (end != std::string_view::npos) {
      head = there.substr(0, end);
      begin_ += end;
      return Head::kWhole;
    }
    const Fill filled = fill(deadline);
    if (filled != Fill::kBytes) return filled == Fill::kTimeUp ? Head::kTooSlow : Head::kCut;
  }
}

void Connection::put_back(const std::string& head) {
  received_.replace(0, begin_, head);
  begin_ = 0;
}

bool Connection::is_readable() const {
  if (begin_ < received_.size()) return true;
  pollfd entry{socket_, POLLIN, 0};
  return ::poll(&entry, 1, 0) > 0;
}

bool Connection::is_writable() const {
  char next = 0;
  const ssize_t got = ::recv(socket_, &next, 1, MSG_PEEK | MSG_DONTWAIT);
  return got > 0 || (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR));
}

ssize_t Connection::read(char* data, std::size_t size) {
  if (begin_ == received_.size() && fill(limit_.deadline()) != Fill::kBytes) return -1;
  const std::size_t count = std::min(size, received_.size() - begin_);
  std::memcpy(data, received_.data() + begin_, count);
  begin_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t Connection::write(const char* data, std::size_t size) {
  const Clock::time_point deadline = limit_.deadline();
  for (std::size_t done = 0; done < size;) {
    const ssize_t sent = ::send(socket_, data + done, size - done, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      done += static_cast<std::size_t>(sent);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!wait_for(POLLOUT, deadline)) return -1;
    } else if (errno != EINTR) {
      return -1;
    }
  }
  return static_cast<ssize_t>(size);
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0)
    read_address(address, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0)
    read_address(address, ip, port);
}

}  // namespace tvg::server
