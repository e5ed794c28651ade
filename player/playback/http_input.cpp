#include "player/playback/http_input.hpp"

#include "player/playback/http_transfer.hpp"
#include "player/playback/input_error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

// What readers ask of the input. http_downloading.cpp has the thread that fetches.
namespace tvg::player {

namespace {

void* make_multi() {
  static const CURLcode kReady = curl_global_init(CURL_GLOBAL_DEFAULT);
  return kReady == CURLE_OK ? curl_multi_init() : nullptr;
}

std::string without_user(const std::string& url) {
  const std::size_t scheme = url.find("://");
  const std::size_t host = scheme == std::string::npos ? 0 : scheme + 3;
  const std::size_t at = url.substr(0, url.find('/', host)).rfind('@');
  return at == std::string::npos || at < host ? url : url.substr(0, host) + url.substr(at + 1);
}

}  // namespace

HttpInput::HttpInput(std::string url, const HttpOptions& options)
    : url_(std::move(url)),
      name_(without_user(url_)),
      options_(options),
      multi_(make_multi()),
      cache_(std::max(options.cache_bytes, 2 * options.read_ahead)) {
  if (multi_ == nullptr) {
    failure_ = input_error(name_, "libcurl cannot be started");
    return;
  }
  thread_ = std::thread([this] { run(); });
}

HttpInput::~HttpInput() {
  cancel();
  if (thread_.joinable()) thread_.join();
  main_.reset();
  aside_.reset();
  if (multi_ != nullptr) curl_multi_cleanup(multi_);
}

std::optional<std::uint64_t> HttpInput::size() const {
  const std::lock_guard lock(mutex_);
  return size_;
}

Result<std::size_t> HttpInput::read(std::uint64_t offset, std::span<std::uint8_t> target) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (cancelled_ || interrupted_) return input_error(name_, "reading was ended");
    reader_ = offset;
    wake();
    const std::size_t count = cache_.read(offset, target);
    if (count > 0) return count;
    if (size_ && offset >= *size_) return std::size_t{0};
    if (failure_) return *failure_;
    news_.wait(lock);
  }
}

Result<std::vector<std::uint8_t>> HttpInput::read_aside(const ByteRange& range) {
  constexpr std::uint64_t kTailFetched = std::uint64_t{1} << 16;
  std::unique_lock lock(mutex_);
  if (!size_ || range.offset > *size_ || range.size > *size_ - range.offset) {
    return input_error(name_, "there are no such bytes");
  }
  const std::uint64_t tail_offset = *size_ - tail_.size();
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(range.size));
  if (range.offset >= tail_offset) {
    const auto at = tail_.begin() + static_cast<std::ptrdiff_t>(range.offset - tail_offset);
    std::copy_n(at, bytes.size(), bytes.begin());
    return bytes;
  }
  if (cache_.read(range.offset, bytes) == bytes.size()) return bytes;
  if (ranges_ == Ranges::kNo || aside_) return input_error(name_, "ranges cannot be had");
  const auto aside = std::make_shared<Aside>();
  aside->range = range;
  const std::uint64_t tail = *size_ - std::min(*size_, kTailFetched);
  const bool in_tail = range.offset >= tail;
  if (in_tail) aside->range = {tail, *size_ - tail};
  aside_ = aside;
  wake();
  news_.wait(lock, [&] { return aside->done || cancelled_; });
  if (!aside->done) return input_error(name_, "reading was ended");
  if (aside->failure) return *aside->failure;
  if (!in_tail) return std::move(aside->bytes);
  tail_ = std::move(aside->bytes);
  const auto at = tail_.begin() + static_cast<std::ptrdiff_t>(range.offset - tail);
  std::copy_n(at, bytes.size(), bytes.begin());
  return bytes;
}

bool HttpInput::reaches(std::uint64_t offset) const {
  const std::lock_guard lock(mutex_);
  return !live_ || cache_.first_missing(offset) > offset;
}

bool HttpInput::begin_anew() {
  const std::lock_guard lock(mutex_);
  if (!live_ || !failure_ || !may_try_again_ || cancelled_) return false;
  failure_.reset();
  cache_.clear();
  live_ = false;
  size_.reset();
  etag_.clear();
  reader_ = 0;
  wake();
  return true;
}

void HttpInput::interrupt() {
  const std::lock_guard lock(mutex_);
  interrupted_ = true;
  news_.notify_all();
}

void HttpInput::resume() {
  const std::lock_guard lock(mutex_);
  interrupted_ = false;
  if (failure_ && may_try_again_ && !live_) {
    failure_.reset();
    attempts_ = 0;
    retry_at_ = {};
  }
}

void HttpInput::cancel() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  news_.notify_all();
  wake();
}

std::vector<ByteRange> HttpInput::buffered() const {
  const std::lock_guard lock(mutex_);
  return cache_.ranges();
}

InputStatus HttpInput::status() const {
  const std::lock_guard lock(mutex_);
  if (failure_) return {InputStatus::Activity::kFailed, failure_->message, received_};
  if (!reason_.empty()) return {InputStatus::Activity::kWaiting, reason_, received_};
  if (received_ == 0) return {InputStatus::Activity::kConnecting, "", 0};
  const std::uint64_t hole = cache_.first_missing(reader_);
  const bool rests = (size_ && hole >= *size_) || hole - reader_ >= options_.read_ahead;
  return {rests ? InputStatus::Activity::kResting : InputStatus::Activity::kReceiving, "", received_};
}

void HttpInput::wake() {
  if (multi_ != nullptr) curl_multi_wakeup(multi_);
}

}  // namespace tvg::player
