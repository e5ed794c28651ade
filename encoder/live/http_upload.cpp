#include "encoder/live/http_upload.hpp"

#include "tool/tool_error.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace tvg::cli {

namespace {

constexpr long kConnectSeconds = 10;
constexpr std::chrono::seconds kPatience{30};  // with a server that takes nothing or does not answer
constexpr int kPollMilliseconds = 200;
constexpr std::size_t kMostAnswer = 1000;

}  // namespace

HttpUpload::HttpUpload(std::string url)
    : url_(std::move(url)),
      headers_(curl_slist_append(nullptr, "Content-Type: model/vnd.tvg")),
      multi_(curl_multi_init()),
      easy_(curl_easy_init()) {
  if (multi_ == nullptr || easy_ == nullptr || headers_ == nullptr) fail("libcurl cannot be started");
  CURL* easy = easy_.get();
  curl_easy_setopt(easy, CURLOPT_URL, url_.c_str());
  curl_easy_setopt(easy, CURLOPT_UPLOAD, 1L);
  curl_easy_setopt(easy, CURLOPT_HTTP_VERSION, CURL_HTTP_VERSION_1_1);  // a body of unknown length in chunks
  curl_easy_setopt(easy, CURLOPT_HTTPHEADER, headers_.get());
  curl_easy_setopt(easy, CURLOPT_USERAGENT, "tvg");
  curl_easy_setopt(easy, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(easy, CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
  curl_easy_setopt(easy, CURLOPT_READFUNCTION, &HttpUpload::give_bytes);
  curl_easy_setopt(easy, CURLOPT_READDATA, this);
  curl_easy_setopt(easy, CURLOPT_WRITEFUNCTION, &HttpUpload::take_answer);
  curl_easy_setopt(easy, CURLOPT_WRITEDATA, this);
  curl_multi_add_handle(multi_.get(), easy);
}

HttpUpload::~HttpUpload() {
  // Closes the connection where the upload is not complete: the server then drops what is unfinished.
  curl_multi_remove_handle(multi_.get(), easy_.get());
}

std::size_t HttpUpload::give_bytes(char* target, std::size_t size, std::size_t count, void* upload) {
  auto& self = *static_cast<HttpUpload*>(upload);
  if (self.left_.empty()) {
    if (self.at_end_) return 0;
    self.starved_ = true;
    return CURL_READFUNC_PAUSE;
  }
  const std::size_t given = std::min(size * count, self.left_.size());
  std::memcpy(target, self.left_.data(), given);
  self.left_ = self.left_.subspan(given);
  return given;
}

std::size_t HttpUpload::take_answer(char* bytes, std::size_t size, std::size_t count, void* upload) {
  auto& self = *static_cast<HttpUpload*>(upload);
  self.answer_.append(bytes, std::min(size * count, kMostAnswer - self.answer_.size()));
  return size * count;
}

void HttpUpload::read_messages() {
  int left = 0;
  while (const CURLMsg* message = curl_multi_info_read(multi_.get(), &left)) {
    if (message->msg != CURLMSG_DONE) continue;
    done_ = true;
    result_ = message->data.result;
  }
}

/// Lets curl work until it wants more bytes or, `to_the_end`, until it has the server's answer.
void HttpUpload::drive(bool to_the_end) {
  if (std::exchange(starved_, false)) {
    if (const CURLcode code = curl_easy_pause(easy_.get(), CURLPAUSE_CONT); code != CURLE_OK)
      fail(curl_easy_strerror(code));
  }
  auto deadline = std::chrono::steady_clock::now() + kPatience;
  for (std::size_t last_left = left_.size(); !done_ && (to_the_end || !starved_);) {
    int running = 0;
    if (const CURLMcode code = curl_multi_perform(multi_.get(), &running); code != CURLM_OK)
      fail(curl_multi_strerror(code));
    read_messages();
    if (done_ || (starved_ && !to_the_end)) break;
    const auto now = std::chrono::steady_clock::now();
    if (left_.size() != last_left) deadline = now + kPatience;
    last_left = left_.size();
    if (now > deadline) fail(fmt::format("the server has taken nothing for {} s", kPatience.count()));
    curl_multi_poll(multi_.get(), nullptr, 0, kPollMilliseconds, nullptr);
  }
}

void HttpUpload::write(std::span<const std::uint8_t> bytes) {
  left_ = bytes;
  if (!done_) drive(false);
  if (done_) fail_with_answer();
}

void HttpUpload::finish() {
  at_end_ = true;
  if (!done_) drive(true);
  long status = 0;
  curl_easy_getinfo(easy_.get(), CURLINFO_RESPONSE_CODE, &status);
  if (result_ != CURLE_OK || status < 200 || status > 299) fail_with_answer();
}

void HttpUpload::fail_with_answer() const {
  long status = 0;
  curl_easy_getinfo(easy_.get(), CURLINFO_RESPONSE_CODE, &status);
  std::string text = answer_.substr(0, answer_.find('\n'));
  // Another server's words end up on a terminal.
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c >= 0 && (c < ' ' || c == 0x7F); }, ' ');
  if (status >= 200) {
    const char* early = status < 300 ? " before the stream was complete" : "";
    fail(fmt::format("the server answers {}{}{}{}", status, early, text.empty() ? "" : ": ", text));
  }
  fail(result_ == CURLE_OK ? "the server closed the connection" : curl_easy_strerror(result_));
}

void HttpUpload::fail(const std::string& reason) const {
  throw ToolError(ExitStatus::kIo, fmt::format("cannot upload to {}: {}", url_, reason));
}

}  // namespace tvg::cli
