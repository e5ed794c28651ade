#include "server/live_routes.hpp"

#include "server/listing.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <string_view>

namespace tvg::server {

namespace {

constexpr std::string_view kPrefix = "/live/";
constexpr std::size_t kLongestName = 64;
constexpr std::size_t kPieceBytes = std::size_t{1} << 16;
constexpr std::chrono::milliseconds kPatience{500};  // between looks at whether a viewer is still there

void answer(httplib::Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(text + "\n", "text/plain; charset=utf-8");
}

int status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kLimitExceeded:
      return 413;
    case ErrorCode::kIo:
    case ErrorCode::kOutOfMemory:
      return 503;
    default:
      return 400;
  }
}

Status io_error(const char* message) {
  return Error{ErrorCode::kIo, message, {}, {}, ""};
}

/// Writes in pieces, so that each has the time limit for itself and little is copied at once.
Status write_pieces(httplib::DataSink& sink, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::size_t size = std::min(bytes.size(), kPieceBytes);
    if (!sink.write(reinterpret_cast<const char*>(bytes.data()), size))
      return io_error("the viewer does not read");
    bytes = bytes.subspan(size);
  }
  return {};
}

/// Feeds one viewer's answer.
class ViewerBody {
 public:
  ViewerBody(std::shared_ptr<LiveStream> stream, LiveStream::Start start, std::atomic<std::size_t>& viewers)
      : viewer_(std::move(stream), std::move(start)), viewers_(viewers) {
    ++viewers_;
  }
  ~ViewerBody() { --viewers_; }
  ViewerBody(const ViewerBody&) = delete;
  ViewerBody& operator=(const ViewerBody&) = delete;

  bool write_some(httplib::DataSink& sink) {
    if (sink.is_writable && !sink.is_writable()) return false;  // gone while there was nothing to write
    const auto write = [&sink](std::span<const std::uint8_t> bytes) { return write_pieces(sink, bytes); };
    const LiveViewer::Step step = viewer_.step(write, kPatience);
    if (step == LiveViewer::Step::kDone) sink.done();
    return step != LiveViewer::Step::kFailed;
  }

 private:
  LiveViewer viewer_;
  std::atomic<std::size_t>& viewers_;
};

}  // namespace

std::optional<std::string> LiveRoutes::name_of(const std::string& path) {
  if (!path.starts_with(kPrefix)) return std::nullopt;
  std::string name = path.substr(kPrefix.size());
  const bool valid = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (c != '\0' && std::strchr("._-", c) != nullptr);
  });
  if (!valid || name.empty() || name.starts_with('.') || name.size() > kLongestName) return std::nullopt;
  return name;
}

void LiveRoutes::refuse(PublishRefusal refusal, const std::string& name, httplib::Response& response) const {
  switch (refusal) {
    case PublishRefusal::kNameTaken:
      answer(response, 409, fmt::format("{} is being published already: choose another name", name));
      break;
    case PublishRefusal::kTooMany:
      response.set_header("Retry-After", "10");
      answer(response, 503, "there are as many live streams as this server takes (--max-live-streams)");
      break;
    case PublishRefusal::kEnding:
      answer(response, 503, "the server is ending");
      break;
  }
}

bool LiveRoutes::refuse_upload(const httplib::Request& request, httplib::Response& response) const {
  const std::optional<std::string> name = name_of(request.path);
  if (!name) {
    answer(response, 400, "publish to /live/NAME, with 1 to 64 of A-Z a-z 0-9 . _ - as the name");
    return true;
  }
  // Browsers say so when a page makes them send; a page on the web has no business on this machine.
  if (request.has_header("Origin")) {
    answer(response, 403, "web pages cannot publish");
    return true;
  }
  if (request.has_header("Content-Encoding") || request.is_multipart_form_data()) {
    answer(response, 415, "send the stream itself as the body, for example with curl -T");
    return true;
  }
  if (const auto refused = hub_.refusal(*name)) {
    refuse(*refused, *name, response);
    return true;
  }
  return false;
}

void LiveRoutes::log_end(const std::string& name, const LiveStatus& status, const std::string& reason) const {
  if (log_) {
    log_(fmt::format("live {}: ends after {} frames in {} GOPs: {}", name, status.frames, status.gops,
                     reason));
  }
}

void LiveRoutes::publish(const httplib::Request& request, httplib::Response& response,
                         const httplib::ContentReader& read_content) {
  const std::string name = name_of(request.path).value_or("");
  auto begun = hub_.publish(name);
  if (const auto* refused = std::get_if<PublishRefusal>(&begun)) {
    refuse(*refused, name, response);
    return;
  }
  const std::unique_ptr<LivePublisher> publisher = std::move(std::get<std::unique_ptr<LivePublisher>>(begun));
  if (log_) log_(fmt::format("live {}: begins", name));
  Status status;
  const bool all_read = read_content([&](const char* data, std::size_t size) {
    status = publisher->push({reinterpret_cast<const std::uint8_t*>(data), size});
    return status.ok();
  });
  const LiveStatus made = publisher->status();
  if (status.ok() && all_read) status = publisher->finish();
  if (!status.ok()) {
    log_end(name, made, status.error().describe());
    answer(response, status_of(status.error().code), status.error().describe());
  } else if (server_.abandoning()) {
    log_end(name, made, "the server is ending");
    answer(response, 503, "the server is ending");
  } else if (!all_read) {
    log_end(name, made, "the connection was lost or idle for too long");
    answer(response, 400, "the upload was cut off or idle for too long");
  } else {
    log_end(name, made, "complete");
    answer(response, 200, fmt::format("{} frames in {} GOPs", made.frames, made.gops));
  }
}

void LiveRoutes::watch(const httplib::Request& request, httplib::Response& response) {
  const std::string hint = "; GET /live/ lists what is live";
  const std::optional<std::string> name = name_of(request.path);
  const std::shared_ptr<LiveStream> stream = name ? hub_.find(*name) : nullptr;
  if (stream == nullptr) {
    answer(response, 404, name ? *name + " is not live" + hint : "no live stream has such a name" + hint);
    return;
  }
  response.set_header("Cache-Control", "no-store");
  if (request.method == "HEAD") {
    response.status = 200;
    response.set_header("Content-Type", "model/vnd.tvg");
    return;
  }
  std::optional<LiveStream::Start> start;
  for (auto waited = kPatience; !start && waited <= timeout_ && !server_.abandoning(); waited += kPatience)
    start = stream->wait_for_start(kPatience);
  if (!start) {
    answer(response, 404, *name + " has not begun" + hint);
    return;
  }
  response.status = 200;
  const auto body = std::make_shared<ViewerBody>(stream, std::move(*start), viewers_);
  const auto provider = [body](std::size_t, httplib::DataSink& sink) { return body->write_some(sink); };
  if (request.version == "HTTP/1.0") {  // as proxies speak it; the answer ends with the connection
    response.set_header("Connection", "close");
    response.set_content_provider("model/vnd.tvg", provider);
  } else {
    response.set_chunked_content_provider("model/vnd.tvg", provider);
  }
}

void LiveRoutes::list(httplib::Response& response) const {
  response.status = 200;
  response.set_header("Cache-Control", "no-store");
  response.set_content(listing(), "application/json");
}

std::string LiveRoutes::listing() const {
  return live_listing(hub_.list());
}

}  // namespace tvg::server
