#include "server/stream_server.hpp"

#include "server/file_response.hpp"
#include "server/http_server.hpp"
#include "server/listing.hpp"
#include "server/live_routes.hpp"
#include "server/player_files.hpp"
#include "server/start_page.hpp"
#include "tool/tool_error.hpp"

#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace tvg::server {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestPath = 1024;  // also keeps httplib's regular expressions off the stack's end
constexpr std::chrono::milliseconds kDrain{5000};

RelayLimits relay_limits(const ServerOptions& options) {
  RelayLimits limits;
  limits.chunk_bytes = options.max_chunk_bytes;
  return limits;
}

fs::path canonical_folder(const std::string& folder) {
  std::error_code error;
  fs::path path = fs::canonical(folder, error);
  if (error)
    throw cli::ToolError(cli::ExitStatus::kIo, fmt::format("cannot serve {}: {}", folder, error.message()));
  if (!fs::is_directory(path, error)) {
    throw cli::ToolError(cli::ExitStatus::kIo,
                         fmt::format("cannot serve {}: it is no folder; name the one it lies in", folder));
  }
  return path;
}

const char* text_of(int status) {
  switch (status) {
    case 400:
      return "the request is not understood\n";
    case 404:
      return "there is no such file\n";
    case 405:
      return "files can be read only: GET, HEAD, OPTIONS\n";
    case 414:
      return "the path is too long\n";
    case 416:
      return "the range lies outside the file\n";
    default:
      return "the request failed\n";
  }
}

bool is_live_path(const std::string& path) {
  return path == "/live" || path.starts_with("/live/");
}

}  // namespace

class StreamServer::Implementation {
 public:
  explicit Implementation(ServerOptions options)
      : options_(std::move(options)),
        root_(canonical_folder(options_.folder)),
        player_(options_.player),
        http_(options_.max_clients, options_.max_per_address, {options_.timeout, options_.now}),
        live_(http_, options_.max_live_streams, relay_limits(options_), options_.timeout, options_.log) {
    add_routes();
    errno = 0;
    port_ = options_.port == 0                                    ? http_.bind_to_any_port(options_.address)
            : http_.bind_to_port(options_.address, options_.port) ? options_.port
                                                                  : -1;
    if (port_ < 0) {
      const int reason = errno;
      throw cli::ToolError(
          cli::ExitStatus::kIo,
          fmt::format("cannot listen on {} port {}: {}", options_.address, options_.port,
                      reason == EADDRINUSE ? "another program does; choose another with --port, or 0 for any"
                                           : (reason != 0 ? std::generic_category().message(reason)
                                                          : "it is no address of this machine")));
    }
    http_.widen_backlog();
  }
  ~Implementation() { stop(); }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  std::string url() const {
    const bool v6 = options_.address.find(':') != std::string::npos;
    return fmt::format("http://{}:{}", v6 ? "[" + options_.address + "]" : options_.address, port_);
  }
  int port() const { return port_; }

  void start() {
    thread_ = std::thread([this] { http_.listen_after_bind(); });
    while (!http_.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  void stop() {
    const std::lock_guard lock(stop_mutex_);
    if (!thread_.joinable()) return;
    live_.end_all();
    const auto deadline = std::chrono::steady_clock::now() + kDrain;
    while (live_.viewers() > 0 && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    http_.abandon_clients();
    http_.stop();
    thread_.join();
  }

 private:
  void add_routes() {
    using Answer = httplib::Server::HandlerResponse;
    http_.set_default_headers({{"Access-Control-Allow-Origin", "*"},
                               {"Access-Control-Expose-Headers",
                                "Content-Range, ETag, Accept-Ranges, Content-Length, Last-Modified"},
                               {"X-Content-Type-Options", "nosniff"}});
    http_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      return route(request, response) ? Answer::Handled : Answer::Unhandled;
    });
    http_.set_expect_100_continue_handler([this](const httplib::Request& request,
                                                 httplib::Response& response) {
      // Refused here, an upload is not even sent.
      const bool sends = request.method != "GET" && request.method != "HEAD" && request.method != "OPTIONS";
      if (sends && route(request, response)) return response.status;
      return 100;
    });
    const auto publish = [this](const httplib::Request& request, httplib::Response& response,
                                const httplib::ContentReader& read_content) {
      live_.publish(request, response, read_content);
    };
    http_.Put("/live/.*", publish);
    http_.Post("/live/.*", publish);
    http_.set_error_handler(
        httplib::Server::HandlerWithResponse([](const httplib::Request&, httplib::Response& response) {
          if (!response.body.empty() || response.status < 400) return Answer::Handled;
          response.set_content(text_of(response.status), "text/plain; charset=utf-8");
          return Answer::Handled;
        }));
  }

  /// Answers everything but uploads, which are handed on once they are known to be wanted.
  bool route(const httplib::Request& request, httplib::Response& response) {
    const bool live = options_.live && is_live_path(request.path);
    if (request.path.size() > kLongestPath) {
      response.status = 414;
    } else if (request.method == "OPTIONS") {
      response.status = 204;
      response.set_header("Allow", live ? "GET, HEAD, OPTIONS, PUT, POST" : "GET, HEAD, OPTIONS");
      response.set_header("Access-Control-Allow-Methods", "GET, HEAD, OPTIONS");
      response.set_header("Access-Control-Allow-Headers",
                          "Range, If-Range, If-None-Match, If-Modified-Since");
      response.set_header("Access-Control-Max-Age", "86400");
    } else if (live && (request.method == "PUT" || request.method == "POST")) {
      return live_.refuse_upload(request, response);
    } else if (request.method != "GET" && request.method != "HEAD") {
      response.status = 405;
      response.set_header("Allow", "GET, HEAD, OPTIONS");
    } else if (live && (request.path == "/live" || request.path == "/live/")) {
      live_.list(response);
    } else if (live) {
      live_.watch(request, response);
    } else if (!player_.answer(request, response)) {
      respond_from_folder(request, response);
    }
    return true;
  }

  void respond_from_folder(const httplib::Request& request, httplib::Response& response) const {
    const bool is_start = request.path == PlayerFiles::kFolder;
    const auto target = is_start ? root_ : resolve_in_folder(root_, request.path);
    std::error_code error;
    if (!target) {
      response.status = 404;
    } else if (!fs::is_directory(*target, error)) {
      respond_with_file(*target, request, response);
    } else if (is_start || wants_html(request)) {
      respond_with_page(*target, is_start, request, response);
    } else {
      response.status = 200;
      response.set_header("Cache-Control", "no-store");
      response.set_header("Vary", "Accept");
      response.set_content(folder_listing(root_, *target), "application/json");
    }
  }

  /// A folder for a browser: its own page unless `is_start`, or what is in it.
  void respond_with_page(const fs::path& folder, bool is_start, const httplib::Request& request,
                         httplib::Response& response) const {
    response.set_header("Vary", "Accept");
    if (!request.path.ends_with('/')) {  // what the page names is beside it
      response.status = 307;
      response.set_header("Location", fmt::format("/{}/", url_of(folder.lexically_relative(root_).string())));
      return;
    }
    if (const auto page = resolve_in_folder(root_, request.path + "index.html"); page && !is_start)
      return respond_with_file(*page, request, response);
    const bool tells_live = options_.live && folder == root_;
    response.set_header("Content-Security-Policy",
                        "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
                        "form-action 'none'");
    respond_with_text(
        start_page(folder_listing(root_, folder), tells_live ? std::optional(live_.listing()) : std::nullopt,
                   player_.available()),
        "text/html; charset=utf-8", request, response);
  }

  const ServerOptions options_;
  const fs::path root_;
  const PlayerFiles player_;
  HttpServer http_;
  LiveRoutes live_;
  int port_ = -1;
  std::thread thread_;
  std::mutex stop_mutex_;
};

StreamServer::StreamServer(ServerOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(options))) {}
StreamServer::~StreamServer() = default;

std::string StreamServer::url() const {
  return implementation_->url();
}

int StreamServer::port() const {
  return implementation_->port();
}

void StreamServer::start() {
  implementation_->start();
}

void StreamServer::stop() {
  implementation_->stop();
}

}  // namespace tvg::server
