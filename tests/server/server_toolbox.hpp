#pragma once
#include "server/stream_server.hpp"
#include "tests/codec/codec_toolbox.hpp"
#include "tests/importers/io_toolbox.hpp"

#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <httplib.h>
#include <memory>
#include <mutex>
#include <netinet/in.h>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace tvg::server::testing {

/// A clock that stands still until a test moves it on: what a time limit does is then no matter of how busy
/// the machine is. Copies are the same clock.
class StoppedClock {
 public:
  std::chrono::steady_clock::time_point operator()() const {
    return std::chrono::steady_clock::time_point(std::chrono::milliseconds(time_->load()));
  }
  void move_on(std::chrono::milliseconds time) { time_->fetch_add(time.count()); }

 private:
  std::shared_ptr<std::atomic<std::int64_t>> time_ = std::make_shared<std::atomic<std::int64_t>>(0);
};

/// A server in this process on a port of its own, and clients for it.
class RunningServer {
 public:
  explicit RunningServer(const std::string& folder, const std::function<void(ServerOptions&)>& change = {}) {
    ServerOptions options;
    options.folder = folder;
    options.port = 0;
    if (change) change(options);
    server_ = std::make_unique<StreamServer>(std::move(options));
    server_->start();
  }

  StreamServer& operator*() { return *server_; }
  int port() const { return server_->port(); }
  httplib::Client client() const {
    httplib::Client client("127.0.0.1", server_->port());
    client.set_read_timeout(60);
    return client;
  }

 private:
  std::unique_ptr<StreamServer> server_;
};

/// A connection whose bytes the test gives itself.
class RawClient {
 public:
  /// From `from`, an address of loopback; with a buffer of so many bytes for what it does not read.
  explicit RawClient(int port, const char* from = "127.0.0.1", int buffer = 0) {
    if (buffer > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
    sockaddr_in own = address_of(from, 0);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&own), sizeof own), 0);
    sockaddr_in address = address_of("127.0.0.1", port);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    const timeval only_a_hang{60, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &only_a_hang, sizeof only_a_hang);
  }
  ~RawClient() { ::close(socket_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  void send(const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t now = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (now <= 0) break;
      sent += static_cast<std::size_t>(now);
    }
  }
  /// Says that it sends nothing more.
  void end() { ::shutdown(socket_, SHUT_WR); }
  /// The next answer up to its empty line, or to where the server closes.
  std::string head() {
    std::string head;
    for (char c = 0; !head.ends_with("\r\n\r\n") && ::recv(socket_, &c, 1, 0) > 0;) head += c;
    return head;
  }
  /// Everything up to where the server closes.
  std::string answer() {
    std::string answer;
    std::array<char, 4096> piece{};
    for (ssize_t got; (got = ::recv(socket_, piece.data(), piece.size(), 0)) > 0;)
      answer.append(piece.data(), static_cast<std::size_t>(got));
    return answer;
  }

 private:
  static sockaddr_in address_of(const char* text, int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    EXPECT_EQ(::inet_pton(AF_INET, text, &address.sin_addr), 1);
    return address;
  }

  int socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
};

/// A stream of `gops` GOPs of two frames.
inline test::Stream make_live_stream(std::size_t gops, unsigned seed = 1, EncodeOptions options = {}) {
  std::mt19937 random(seed);
  const Sequence sequence = test::random_sequence(test::grid(6, 5), 2 * gops, random);
  options.gop_frames = 2;
  return test::encode_sequence(sequence, options);
}

/// The same in mode basis, with so many GOPs to a period.
inline test::Stream make_live_basis(std::size_t gops, std::uint32_t gops_of_period) {
  EncodeOptions options;
  options.mode = Mode::kBasis;
  options.period_frames = 2 * gops_of_period;
  return make_live_stream(gops, 1, options);
}

/// Where each GOP of a stream ends, in bytes; [0] is where the first begins.
inline std::vector<std::size_t> gop_borders(const test::Stream& stream) {
  std::vector<std::size_t> borders;
  for (const IndexEntry& entry : test::decode_stream(stream).index) {
    if (entry.kind == IndexEntry::Kind::kGop) borders.push_back(static_cast<std::size_t>(entry.offset));
  }
  const Result<ByteRange> index = locate_index(std::span(stream).last(kTailBytes), stream.size());
  EXPECT_TRUE(index);
  borders.push_back(static_cast<std::size_t>(index->offset));
  return borders;
}

inline std::string text_of(const test::Stream& stream, std::size_t begin, std::size_t end) {
  return {stream.begin() + static_cast<std::ptrdiff_t>(begin),
          stream.begin() + static_cast<std::ptrdiff_t>(end)};
}

inline test::DecodedStream decode_text(const std::string& bytes) {
  return test::decode_stream(test::Stream(bytes.begin(), bytes.end()));
}

/// Waits for what other threads bring about; false after a time that only a hang exceeds.
inline bool eventually(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// An upload whose bytes the test gives piece by piece.
class Upload {
 public:
  Upload(const RunningServer& server, const std::string& path, bool post = false)
      : client_(server.client()), thread_([this, path, post] {
          const auto give = [this](std::size_t, httplib::DataSink& sink) { return give_bytes(sink); };
          auto answer =
              post ? client_.Post(path, give, "model/vnd.tvg") : client_.Put(path, give, "model/vnd.tvg");
          if (answer) {
            status_ = answer->status;
            text_ = answer->body;
          }
        }) {}
  ~Upload() {
    if (thread_.joinable()) break_off();
  }
  Upload(const Upload&) = delete;
  Upload& operator=(const Upload&) = delete;

  void send(std::string bytes) { add({Step::kSend, std::move(bytes)}); }
  /// The body is complete; waits for the answer.
  void finish() {
    add({Step::kFinish, {}});
    thread_.join();
  }
  /// Closes the connection as a killed encoder's is closed.
  void break_off() {
    add({Step::kBreak, {}});
    thread_.join();
  }
  /// 0 where there was no answer. After finish() or break_off().
  int status() const { return status_; }
  const std::string& text() const { return text_; }

 private:
  enum class Step { kSend, kFinish, kBreak };

  void add(std::pair<Step, std::string> step) {
    const std::lock_guard lock(mutex_);
    steps_.push_back(std::move(step));
    changed_.notify_all();
  }
  bool give_bytes(httplib::DataSink& sink) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !steps_.empty(); });
    const auto [step, bytes] = std::move(steps_.front());
    steps_.pop_front();
    if (step == Step::kBreak) return false;
    if (step == Step::kSend) return sink.write(bytes.data(), bytes.size());
    sink.done();
    return true;
  }

  httplib::Client client_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<Step, std::string>> steps_;
  int status_ = 0;
  std::string text_;
  std::thread thread_;
};

/// Someone who watches a live stream until it ends.
class Viewer {
 public:
  Viewer(const RunningServer& server, const std::string& path)
      : client_(server.client()), thread_([this, path] {
          const auto answer = client_.Get(path, [this](const char* data, std::size_t size) {
            const std::lock_guard lock(mutex_);
            bytes_.append(data, size);
            return !leave_;
          });
          whole_ = static_cast<bool>(answer);
          status_ = answer ? answer->status : 0;
        }) {}
  ~Viewer() {
    if (!thread_.joinable()) return;
    leave();
  }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  std::string received() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }
  /// Waits for the end of the stream.
  void wait() { thread_.join(); }
  /// Closes the connection as a killed viewer's is closed.
  void leave() {
    leave_ = true;
    client_.stop();
    thread_.join();
  }
  /// Whether the answer came to a proper end. After wait().
  bool whole() const { return whole_; }
  int status() const { return status_; }

 private:
  httplib::Client client_;
  mutable std::mutex mutex_;
  std::string bytes_;
  std::atomic<bool> leave_{false};
  bool whole_ = false;
  int status_ = 0;
  std::thread thread_;
};

}  // namespace tvg::server::testing
