#include "server/file_response.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <fcntl.h>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;
constexpr std::size_t kMostRanges = 16;

/// A regular file open for reading.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW)) {
    valid_ = descriptor_ >= 0 && ::fstat(descriptor_, &status_) == 0 && S_ISREG(status_.st_mode);
  }
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool valid() const { return valid_; }
  std::uint64_t size() const { return static_cast<std::uint64_t>(status_.st_size); }
  std::time_t modified() const { return status_.st_mtim.tv_sec; }
  std::string etag() const {
    return fmt::format("\"{:x}.{:x}-{:x}\"", status_.st_mtim.tv_sec, status_.st_mtim.tv_nsec, size());
  }
  /// Fewer bytes than asked for at the end of the file, or where it cannot be read.
  std::size_t read_at(std::uint64_t offset, char* data, std::size_t size) const {
    for (;;) {
      const ssize_t got = ::pread(descriptor_, data, size, static_cast<off_t>(offset));
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) return 0;
    }
  }

 private:
  int descriptor_;
  bool valid_ = false;
  struct stat status_ {};
};

std::string http_date(std::time_t time) {
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  std::array<char, 64> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &parts)};
}

std::optional<std::time_t> parse_http_date(const std::string& text) {
  std::tm parts{};
  const char* end = ::strptime(text.c_str(), "%a, %d %b %Y %H:%M:%S GMT", &parts);
  if (end == nullptr || *end != '\0') return std::nullopt;
  return ::timegm(&parts);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// The next element of a comma-separated list, which is taken off it.
std::string_view next_element(std::string_view& list) {
  const std::size_t comma = std::min(list.find(','), list.size());
  const std::string_view element = trimmed(list.substr(0, comma));
  list.remove_prefix(std::min(comma + 1, list.size()));
  return element;
}

bool is_unchanged(const httplib::Request& request, const OpenFile& file) {
  if (request.has_header("If-None-Match")) {
    const std::string header = request.get_header_value("If-None-Match");
    for (std::string_view list = header; !list.empty();) {
      std::string_view tag = next_element(list);
      if (tag.starts_with("W/")) tag.remove_prefix(2);
      if (tag == "*" || tag == file.etag()) return true;
    }
    return false;
  }
  const auto since = parse_http_date(request.get_header_value("If-Modified-Since"));
  return since && *since >= file.modified();
}

bool range_is_wanted(const httplib::Request& request, const OpenFile& file) {
  if (request.method != "GET" || !request.has_header("Range")) return false;
  if (!request.has_header("If-Range")) return true;
  const std::string condition = request.get_header_value("If-Range");
  return condition == file.etag() || condition == http_date(file.modified());
}

bool parse_number(std::string_view text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// A body made of texts and of spans of a file.
class SegmentedBody {
 public:
  explicit SegmentedBody(std::shared_ptr<OpenFile> file) : file_(std::move(file)) {}

  void add(std::string text) { segments_.push_back({std::move(text), {}}); }
  void add(const ByteSpan& span) { segments_.push_back({"", span}); }
  std::uint64_t size() const {
    std::uint64_t size = 0;
    for (const Segment& segment : segments_) size += segment.text.size() + segment.span.size;
    return size;
  }

  /// Writes the next piece; false when the file has become shorter or the receiver has gone.
  bool write_some(httplib::DataSink& sink) {
    while (current_ < segments_.size()) {
      Segment& segment = segments_[current_];
      if (!segment.text.empty()) {
        const std::string text = std::exchange(segment.text, {});
        return sink.write(text.data(), text.size());
      }
      if (segment.span.size > 0) {
        const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(segment.span.size, kPieceBytes));
        piece_.resize(kPieceBytes);
        const std::size_t got = file_->read_at(segment.span.offset, piece_.data(), wanted);
        segment.span.offset += got;
        segment.span.size -= got;
        return got > 0 && sink.write(piece_.data(), got);
      }
      ++current_;
    }
    sink.done();
    return true;
  }

 private:
  struct Segment {
    std::string text;
    ByteSpan span;
  };

  std::shared_ptr<OpenFile> file_;
  std::vector<Segment> segments_;
  std::size_t current_ = 0;
  std::vector<char> piece_;
};

std::string content_range(const ByteSpan& range, std::uint64_t size) {
  return fmt::format("bytes {}-{}/{}", range.offset, range.offset + range.size - 1, size);
}

void set_body(SegmentedBody body, const std::string& type, httplib::Response& response) {
  // httplib would apply the request's ranges to a body whose length it knows, unchecked.
  response.set_header("Content-Length", std::to_string(body.size()));
  const auto shared = std::make_shared<SegmentedBody>(std::move(body));
  response.set_content_provider(
      type, [shared](std::size_t, httplib::DataSink& sink) { return shared->write_some(sink); });
}

void respond_with_ranges(std::shared_ptr<OpenFile> file, const std::vector<ByteSpan>& ranges,
                         const std::string& type, httplib::Response& response) {
  const std::uint64_t size = file->size();
  SegmentedBody body(std::move(file));
  if (ranges.size() == 1) {
    response.set_header("Content-Range", content_range(ranges[0], size));
    body.add(ranges[0]);
    set_body(std::move(body), type, response);
    return;
  }
  // A boundary need not be secret: receivers go by Content-Range.
  constexpr const char* kBoundary = "tvg_range_boundary_5f0c3a91";
  for (const ByteSpan& range : ranges) {
    body.add(fmt::format("\r\n--{}\r\nContent-Type: {}\r\nContent-Range: {}\r\n\r\n", kBoundary, type,
                         content_range(range, size)));
    body.add(range);
  }
  body.add(fmt::format("\r\n--{}--\r\n", kBoundary));
  set_body(std::move(body), fmt::format("multipart/byteranges; boundary={}", kBoundary), response);
}

}  // namespace

std::optional<fs::path> resolve_in_folder(const fs::path& root, const std::string& request_path) {
  fs::path path = root;
  for (std::size_t begin = 0; begin < request_path.size();) {
    const std::size_t end = std::min(request_path.find('/', begin), request_path.size());
    const std::string part = request_path.substr(begin, end - begin);
    if (part.starts_with('.') || part.find('\0') != std::string::npos) return std::nullopt;
    if (!part.empty()) path /= part;
    begin = end + 1;
  }
  std::error_code error;
  const fs::path target = fs::canonical(path, error);
  if (error) return std::nullopt;
  const auto [root_end, beyond] = std::mismatch(root.begin(), root.end(), target.begin(), target.end());
  if (root_end != root.end()) return std::nullopt;
  const bool hidden =
      std::any_of(beyond, target.end(), [](const fs::path& part) { return part.string().starts_with('.'); });
  if (hidden) return std::nullopt;
  return target;
}

std::string content_type_of(const fs::path& file) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 11> kTypes = {{
      {".tvg", "model/vnd.tvg"},
      {".obj", "model/obj"},
      {".stl", "model/stl"},
      {".json", "application/json"},
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".txt", "text/plain; charset=utf-8"},
      {".wasm", "application/wasm"},
      {".png", "image/png"},
      {".mp4", "video/mp4"},
  }};
  const std::string suffix = file.extension().string();
  for (const auto& [known, type] : kTypes) {
    if (suffix == known) return type;
  }
  return "application/octet-stream";
}

RangeChoice choose_ranges(const std::string& header, std::uint64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  std::string_view list = header;
  if (!list.starts_with(kUnit)) return {};
  list.remove_prefix(kUnit.size());
  std::vector<ByteSpan> ranges;
  std::size_t count = 0;
  std::uint64_t total = 0;
  while (!list.empty()) {
    const std::string_view range = next_element(list);
    const std::size_t dash = range.find('-');
    if (dash == std::string_view::npos || ++count > kMostRanges) return {};
    std::uint64_t first = 0;
    std::uint64_t last = size;  // beyond the end: to the end
    const bool has_first = dash > 0;
    const bool has_last = dash + 1 < range.size();
    if (!has_first && !has_last) return {};
    if (has_first && !parse_number(range.substr(0, dash), first)) return {};
    if (has_last && !parse_number(range.substr(dash + 1), last)) return {};
    if (has_first && first > last && has_last) return {};
    if (!has_first) {
      first = size - std::min(last, size);
      last = size;
    }
    if (first >= size) continue;
    ranges.push_back({first, std::min(last, size - 1) - first + 1});
    total += ranges.back().size;
  }
  if (ranges.empty()) return {count > 0, {}};
  if (total > size) return {};
  return {false, std::move(ranges)};
}

void respond_with_file(const fs::path& path, const httplib::Request& request, httplib::Response& response) {
  auto file = std::make_shared<OpenFile>(path);
  if (!file->valid()) {
    response.status = 404;
    return;
  }
  response.set_header("Accept-Ranges", "bytes");
  response.set_header("ETag", file->etag());
  response.set_header("Last-Modified", http_date(file->modified()));
  if (is_unchanged(request, *file)) {
    response.status = 304;
    return;
  }
  const std::string type = content_type_of(path);
  if (range_is_wanted(request, *file)) {
    const RangeChoice choice = choose_ranges(request.get_header_value("Range"), file->size());
    if (choice.unsatisfiable) {
      response.status = 416;
      response.set_header("Content-Range", fmt::format("bytes */{}", file->size()));
      return;
    }
    if (!choice.ranges.empty()) {
      response.status = 206;
      respond_with_ranges(std::move(file), choice.ranges, type, response);
      return;
    }
  }
  response.status = 200;
  SegmentedBody body(file);
  body.add(ByteSpan{0, file->size()});
  set_body(std::move(body), type, response);
}

}  // namespace tvg::cli
