#include "server/file_response.hpp"

#include "server/request_head.hpp"

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

namespace tvg::server {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;

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

/// Whether If-None-Match names the tag.
bool has_tag(const httplib::Request& request, const std::string& etag) {
  const std::string header = request.get_header_value("If-None-Match");
  for (std::string_view list = header; !list.empty();) {
    std::string_view tag = next_element(list);
    if (tag.starts_with("W/")) tag.remove_prefix(2);
    if (tag == "*" || tag == etag) return true;
  }
  return false;
}

bool is_unchanged(const httplib::Request& request, const OpenFile& file) {
  if (request.has_header("If-None-Match")) return has_tag(request, file.etag());
  const auto since = parse_http_date(request.get_header_value("If-Modified-Since"));
  return since && *since >= file.modified();
}

bool range_is_wanted(const httplib::Request& request, const OpenFile& file) {
  if (request.method != "GET" || !request.has_header(kRangeHeader)) return false;
  if (!request.has_header("If-Range")) return true;
  const std::string condition = request.get_header_value("If-Range");
  return condition == file.etag() || condition == http_date(file.modified());
}

bool parse_number(std::string_view text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// Sends a part of a file; it is read while it is sent.
void set_body(std::shared_ptr<OpenFile> file, const ByteSpan& span, const std::string& type,
              httplib::Response& response) {
  if (span.size == 0) return response.set_content("", type);  // httplib takes length 0 for an unknown one
  const auto write_some = [file = std::move(file), begin = span.offset](std::size_t done, std::size_t left,
                                                                        httplib::DataSink& sink) {
    std::array<char, kPieceBytes> piece;
    const std::size_t got = file->read_at(begin + done, piece.data(), std::min(left, kPieceBytes));
    return got > 0 && sink.write(piece.data(), got);  // none: the file has become shorter
  };
  response.set_content_provider(span.size, type, write_some);
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

RangeChoice choose_range(std::string_view header, std::uint64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return {};
  const std::string_view range = trimmed(header.substr(kUnit.size()));
  const std::size_t dash = range.find('-');
  if (dash == std::string_view::npos || range.size() == 1) return {};
  std::uint64_t first = 0;
  std::uint64_t last = size;  // beyond the end: to the end
  const bool has_first = dash > 0;
  const bool has_last = dash + 1 < range.size();
  if (has_first && !parse_number(range.substr(0, dash), first)) return {};
  if (has_last && !parse_number(range.substr(dash + 1), last)) return {};
  if (has_first && has_last && first > last) return {};
  if (!has_first) first = size - std::min(std::exchange(last, size), size);
  if (first >= size) return {true, std::nullopt};
  return {false, ByteSpan{first, std::min(last, size - 1) - first + 1}};
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
  ByteSpan span{0, file->size()};
  response.status = 200;
  if (range_is_wanted(request, *file)) {
    const RangeChoice choice = choose_range(request.get_header_value(kRangeHeader), file->size());
    if (choice.unsatisfiable) {
      response.status = 416;
      response.set_header("Content-Range", fmt::format("bytes */{}", file->size()));
      return;
    }
    if (choice.range) {
      span = *choice.range;
      response.status = 206;
      response.set_header("Content-Range", fmt::format("bytes {}-{}/{}", span.offset,
                                                       span.offset + span.size - 1, file->size()));
    }
  }
  set_body(std::move(file), span, content_type_of(path), response);
}

void respond_with_text(const std::string& text, const std::string& type, const httplib::Request& request,
                       httplib::Response& response) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  const std::string etag = fmt::format("\"{:x}-{:x}\"", hash, text.size());
  response.set_header("ETag", etag);
  response.set_header("Cache-Control", "no-cache");
  response.status = has_tag(request, etag) ? 304 : 200;
  if (response.status == 200) response.set_content(text, type);
}

}  // namespace tvg::server
