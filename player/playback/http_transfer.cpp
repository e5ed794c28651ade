#include "player/playback/http_transfer.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <new>
#include <utility>

namespace tvg::player {

namespace {

constexpr long kMostRedirects = 5;

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

void HttpHead::read_line(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with("HTTP/")) {
    *this = HttpHead();
    const std::size_t space = line.find(' ');
    if (space != std::string_view::npos)
      status = static_cast<long>(number(line.substr(space + 1, 3)).value_or(0));
    return;
  }
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  std::string name(line.substr(0, colon));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (name == "content-length") content_length = number(value);
  if (name == "etag") etag = value;
  if (name == "accept-ranges") refuses_ranges = value == "none";
  if (name == "content-range" && value.starts_with("bytes ")) {
    const std::string_view range = trimmed(value.substr(6));
    const std::size_t dash = range.find('-');
    const std::size_t slash = range.find('/');
    if (dash != std::string_view::npos) range_first = number(range.substr(0, dash));
    if (slash != std::string_view::npos) range_total = number(range.substr(slash + 1));
  }
}

HttpTransfer::HttpTransfer(CURLM* multi, const HttpRequest& request,
                           std::function<Verdict(const HttpHead&, std::span<const std::uint8_t>)> take)
    : multi_(multi), easy_(curl_easy_init()), take_(std::move(take)), last_sign_(Clock::now()) {
  CURL* const easy = easy_.get();
  curl_easy_setopt(easy, CURLOPT_URL, request.url.c_str());
  curl_easy_setopt(easy, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(easy, CURLOPT_REDIR_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(easy, CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(easy, CURLOPT_MAXREDIRS, kMostRedirects);
  curl_easy_setopt(easy, CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(request.connect_timeout.count()));
  curl_easy_setopt(easy, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(easy, CURLOPT_QUICK_EXIT, 1L);  // a name that is looked up must not hold up the window
  curl_easy_setopt(easy, CURLOPT_USERAGENT, "tvg");
  curl_easy_setopt(easy, CURLOPT_ERRORBUFFER, error_);
  curl_easy_setopt(easy, CURLOPT_HEADERFUNCTION, &HttpTransfer::on_header);
  curl_easy_setopt(easy, CURLOPT_HEADERDATA, this);
  curl_easy_setopt(easy, CURLOPT_WRITEFUNCTION, &HttpTransfer::on_body);
  curl_easy_setopt(easy, CURLOPT_WRITEDATA, this);
  if (request.offset > 0 || request.last) {
    const std::string range =
        fmt::format("{}-{}", request.offset, request.last ? std::to_string(*request.last) : "");
    curl_easy_setopt(easy, CURLOPT_RANGE, range.c_str());
    if (!request.validator.empty()) {
      headers_.reset(curl_slist_append(nullptr, ("If-Range: " + request.validator).c_str()));
      curl_easy_setopt(easy, CURLOPT_HTTPHEADER, headers_.get());
    }
  }
  curl_multi_add_handle(multi_, easy);
}

HttpTransfer::~HttpTransfer() {
  curl_multi_remove_handle(multi_, easy_.get());
}

void HttpTransfer::resume() {
  paused_ = false;
  last_sign_ = Clock::now();
  curl_easy_pause(easy_.get(), CURLPAUSE_CONT);
}

std::string HttpTransfer::failure(CURLcode code) const {
  if (out_of_memory_) return "there is not enough memory";
  return error_[0] != '\0' ? error_ : curl_easy_strerror(code);
}

std::size_t HttpTransfer::on_header(char* data, std::size_t size, std::size_t count, void* self) {
  auto& transfer = *static_cast<HttpTransfer*>(self);
  transfer.last_sign_ = Clock::now();
  try {
    transfer.head_.read_line({data, size * count});
  } catch (const std::bad_alloc&) {  // nothing may be thrown through curl
    transfer.out_of_memory_ = true;
    return 0;
  }
  return size * count;
}

std::size_t HttpTransfer::on_body(char* data, std::size_t size, std::size_t count, void* self) {
  auto& transfer = *static_cast<HttpTransfer*>(self);
  transfer.last_sign_ = Clock::now();
  const std::size_t bytes = size * count;
  Verdict verdict = Verdict::kStop;
  try {
    verdict = transfer.take_(transfer.head_, {reinterpret_cast<const std::uint8_t*>(data), bytes});
  } catch (const std::bad_alloc&) {
    transfer.out_of_memory_ = true;
  }
  switch (verdict) {
    case Verdict::kTake:
      return bytes;
    case Verdict::kPause:
      transfer.paused_ = true;
      return CURL_WRITEFUNC_PAUSE;
    case Verdict::kStop:
      break;
  }
  return CURL_WRITEFUNC_ERROR;
}

}  // namespace tvg::player
