#pragma once
#include "playback_toolbox.hpp"

#include <algorithm>
#include <atomic>
#include <httplib.h>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tvg::test {

/// Serves one stream on a port of its own, as well or as badly as a test wants.
class StreamServer {
 public:
  struct Behaviour {
    bool ranges = true;
    bool live = false;  ///< no length
    std::string etag = "\"one\"";
    std::string later_etag;  ///< from the second request on
    int refusals = 0;        ///< requests answered with `refusal` first
    int refusal = 503;
    std::size_t break_after = 0;   ///< bytes of each response, then the connection breaks
    int breaks = 0;                ///< responses that break
    std::size_t extra_length = 0;  ///< claimed beyond the stream's end
    std::size_t hang_after =
        SIZE_MAX;  ///< bytes of a response to a request without a range; then nothing comes
    std::chrono::milliseconds pause{0};  ///< between pieces of 4 KiB
  };

  StreamServer(Stream stream, Behaviour behaviour)
      : stream_(std::move(stream)), behaviour_(std::move(behaviour)) {
    ::setenv("no_proxy", "127.0.0.1", 1);
    server_.Get("/clip.tvg", [this](const httplib::Request& request, httplib::Response& response) {
      answer(request, response);
    });
    server_.Get(R"(/redirected/(\d+))", [](const httplib::Request& request, httplib::Response& response) {
      const int more = std::stoi(request.matches[1].str()) - 1;
      response.set_redirect(more > 0 ? "/redirected/" + std::to_string(more) : "/clip.tvg");
    });
    server_.Get("/to-a-file", [](const httplib::Request&, httplib::Response& response) {
      response.set_redirect("file:///etc/passwd");
    });
    port_ = server_.bind_to_any_port("127.0.0.1");
    EXPECT_GT(port_, 0);
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    EXPECT_TRUE(eventually([this] { return server_.is_running(); }));
  }
  ~StreamServer() {
    stopped_ = true;
    server_.stop();
    thread_.join();
  }
  StreamServer(const StreamServer&) = delete;
  StreamServer& operator=(const StreamServer&) = delete;

  /// `/clip.tvg` is the stream, `/redirected/N` leads there over N redirects, `/to-a-file` to a file here.
  std::string url(const std::string& path = "/clip.tvg") const {
    return "http://127.0.0.1:" + std::to_string(port_) + path;
  }
  /// The Range header of each request so far, "" where it had none.
  std::vector<std::string> requests() const {
    const std::lock_guard lock(mutex_);
    return requests_;
  }

 private:
  void answer(const httplib::Request& request, httplib::Response& response) {
    int number = 0;
    {
      const std::lock_guard lock(mutex_);
      requests_.push_back(request.get_header_value("Range"));
      number = static_cast<int>(requests_.size());
    }
    if (number <= behaviour_.refusals) {
      response.status = behaviour_.refusal;
      response.set_content("no", "text/plain");
      return;
    }
    const std::string etag =
        number > 1 && !behaviour_.later_etag.empty() ? behaviour_.later_etag : behaviour_.etag;
    response.set_header("ETag", etag);
    const std::string condition = request.get_header_value("If-Range");
    // The library answers ranges by itself, unless it does not see them.
    if (!behaviour_.ranges || (!condition.empty() && condition != etag)) {
      const_cast<httplib::Request&>(request).ranges.clear();
    }
    const std::size_t allowed = breaks_made_ < behaviour_.breaks ? behaviour_.break_after : SIZE_MAX;
    const std::size_t hang = request.has_header("Range") ? SIZE_MAX : behaviour_.hang_after;
    const auto sent = std::make_shared<std::size_t>(0);
    const auto write = [this, sent, allowed, hang](std::size_t offset, httplib::DataSink& sink) {
      return write_piece(offset, *sent, allowed, hang, sink);
    };
    if (behaviour_.live) {
      response.set_chunked_content_provider("model/x-tvg", write);
    } else {
      response.set_content_provider(
          stream_.size() + behaviour_.extra_length, "model/x-tvg",
          [write](std::size_t offset, std::size_t, httplib::DataSink& sink) { return write(offset, sink); });
    }
  }

  bool write_piece(std::size_t offset, std::size_t& sent, std::size_t allowed, std::size_t hang,
                   httplib::DataSink& sink) {
    if (stopped_) return false;
    if (sent >= allowed) {
      ++breaks_made_;
      return false;
    }
    if (sent >= hang) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      return true;
    }
    if (offset >= stream_.size()) {
      if (!behaviour_.live) return false;
      sink.done();
      return true;
    }
    const std::size_t count = std::min({stream_.size() - offset, std::size_t{4096}, allowed - sent});
    if (behaviour_.pause.count() > 0) std::this_thread::sleep_for(behaviour_.pause);
    sent += count;
    return sink.write(reinterpret_cast<const char*>(stream_.data()) + offset, count);
  }

  const Stream stream_;
  const Behaviour behaviour_;
  httplib::Server server_;
  int port_ = 0;
  std::atomic<int> breaks_made_ = 0;
  std::atomic<bool> stopped_ = false;
  mutable std::mutex mutex_;
  std::vector<std::string> requests_;
  std::thread thread_;
};

}  // namespace tvg::test
