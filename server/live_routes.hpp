#pragma once
#include "server/http_server.hpp"
#include "server/live_hub.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <httplib.h>
#include <optional>
#include <string>

namespace tvg::server {

/// "/live/NAME" over HTTP: PUT and POST publish, GET watches.
class LiveRoutes {
 public:
  LiveRoutes(const HttpServer& server, std::size_t max_streams, const RelayLimits& limits,
             std::chrono::milliseconds timeout, std::function<void(const std::string&)> log)
      : server_(server), hub_(max_streams, limits), timeout_(timeout), log_(std::move(log)) {}

  /// NAME where the path is /live/NAME with 1 to 64 of A-Z a-z 0-9 . _ -, the first no dot
  static std::optional<std::string> name_of(const std::string& path);

  /// Whether an upload must be refused before its body is read; the answer is then set.
  bool refuse_upload(const httplib::Request& request, httplib::Response& response) const;
  /// Reads an upload to its end and passes it on meanwhile.
  void publish(const httplib::Request& request, httplib::Response& response,
               const httplib::ContentReader& read_content);
  /// Answers GET or HEAD with the stream from its newest GOP on, for as long as it lasts.
  void watch(const httplib::Request& request, httplib::Response& response);
  /// Answers GET or HEAD of /live/.
  void list(httplib::Response& response) const;
  /// The same as text: live_listing().
  std::string listing() const;

  /// Ends all streams; viewers still get their ends.
  void end_all() { hub_.end_all(); }
  std::size_t viewers() const { return viewers_; }

 private:
  void refuse(PublishRefusal refusal, const std::string& name, httplib::Response& response) const;
  void log_end(const std::string& name, const LiveStatus& status, const std::string& reason) const;

  const HttpServer& server_;
  LiveHub hub_;
  std::chrono::milliseconds timeout_;
  std::function<void(const std::string&)> log_;
  std::atomic<std::size_t> viewers_{0};
};

}  // namespace tvg::server
