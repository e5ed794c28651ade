#include "server/farewell.hpp"

#include <array>
#include <cerrno>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace tvg::server {

namespace {

constexpr std::chrono::milliseconds kLinger{1000};
constexpr int kSliceMs = 50;  // how late one who arrives meanwhile is looked after

/// Whether the peer may still send: takes what it has sent.
bool drained(socket_t socket) {
  std::array<char, std::size_t{1} << 12> taken{};
  const ssize_t got = ::recv(socket, taken.data(), taken.size(), MSG_DONTWAIT);
  return got > 0 || (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR));
}

}  // namespace

Farewell::~Farewell() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Farewell::take(socket_t socket) {
  ::shutdown(socket, SHUT_WR);
  if (held_ >= kMost) {
    ::close(socket);
    return;
  }
  ++held_;
  {
    const std::lock_guard lock(mutex_);
    arrived_.push_back({socket, Clock::now() + kLinger});
  }
  changed_.notify_all();
}

void Farewell::run() {
  std::vector<Leaving> leaving;
  std::vector<pollfd> entries;
  for (bool ending = false; !ending || !leaving.empty();) {
    {
      std::unique_lock lock(mutex_);
      if (leaving.empty()) changed_.wait(lock, [this] { return ending_ || !arrived_.empty(); });
      ending = ending_;
      leaving.insert(leaving.end(), arrived_.begin(), arrived_.end());
      arrived_.clear();
    }
    entries.clear();
    for (const Leaving& one : leaving) entries.push_back({one.socket, POLLIN, 0});
    if (!ending) ::poll(entries.data(), entries.size(), kSliceMs);
    const Clock::time_point now = Clock::now();
    std::erase_if(leaving, [&](const Leaving& one) {
      if (!ending && now < one.deadline && drained(one.socket)) return false;
      ::close(one.socket);
      --held_;
      return true;
    });
  }
}

}  // namespace tvg::server
