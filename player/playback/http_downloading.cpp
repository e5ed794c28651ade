#include "player/playback/http_input.hpp"
#include "player/playback/http_transfer.hpp"
#include "player/playback/input_error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <new>
#include <utility>

// The thread that fetches.
namespace tvg::player {

namespace {

/// A strong ETag: only such a one may stand in If-Range.
std::string strong(const std::string& etag) {
  return etag.starts_with("W/") ? "" : etag;
}

bool worth_retrying(long status) {
  return status == 408 || status == 429 || status >= 500;
}

bool worth_retrying(CURLcode code) {
  switch (code) {
    case CURLE_UNSUPPORTED_PROTOCOL:
    case CURLE_URL_MALFORMAT:
    case CURLE_COULDNT_RESOLVE_HOST:
    case CURLE_TOO_MANY_REDIRECTS:
    case CURLE_PEER_FAILED_VERIFICATION:
    case CURLE_OUT_OF_MEMORY:
      return false;
    default:
      return true;
  }
}

}  // namespace

void HttpInput::run() {
  for (bool ended = false; !ended;) {
    try {
      ended = !work();
    } catch (const std::bad_alloc&) {
      const std::lock_guard lock(mutex_);
      give_up("there is not enough memory", true);
    }
  }
}

/// One look at what there is to fetch, and a wait for what comes of it; false after cancel().
bool HttpInput::work() {
  std::chrono::milliseconds wait{};
  bool go_on = false;
  {
    const std::lock_guard lock(mutex_);
    if (cancelled_) return false;
    check_stalls();
    go_on = plan();
    begin_aside();
    wait = time_to_wait();
  }
  if (go_on) main_->resume();  // not under the lock: it may bring bytes at once
  int running = 0;
  curl_multi_perform(multi_, &running);
  finish_transfers();
  curl_multi_poll(multi_, nullptr, 0, static_cast<int>(wait.count()), nullptr);
  return true;
}

std::chrono::milliseconds HttpInput::time_to_wait() const {
  constexpr std::chrono::milliseconds kLongest{500};
  const auto until_retry = std::chrono::ceil<std::chrono::milliseconds>(retry_at_ - Clock::now());
  if (main_ || until_retry <= std::chrono::milliseconds(0)) return std::min(kLongest, options_.stall_timeout);
  return std::min(kLongest, until_retry);
}

/// Decides what the main transfer should bring: the first byte missing ahead of the reader. True where a
/// transfer that pauses should go on.
bool HttpInput::plan() {
  const std::uint64_t hole = cache_.first_missing(reader_);
  const bool enough = hole - reader_ >= options_.read_ahead || (size_ && hole >= *size_);
  if (failure_) {
    main_.reset();
    return false;
  }
  if (enough) return false;
  if (main_ && on_the_way(hole)) {
    return main_->paused() && arriving_ < reader_ + options_.read_ahead / 4 * 3;
  }
  if (live_) {
    give_up(fmt::format("is live: byte {} is not kept any more", hole), false);
  } else if (Clock::now() >= retry_at_) {
    begin_transfer(hole);
  }
  return false;
}

/// Whether the main transfer will come to `hole` sooner than a new one would.
bool HttpInput::on_the_way(std::uint64_t hole) const {
  constexpr double kPatience = 0.2;  // seconds
  constexpr double kLeast = 16384, kMost = 131072;
  if (arriving_ > hole) return false;
  if (ranges_ == Ranges::kNo || live_) return true;
  const std::chrono::duration<double> time = Clock::now() - begun_;
  const double rate = static_cast<double>(transferred_) / std::max(time.count(), 1.0);
  return static_cast<double>(hole - arriving_) <= std::clamp(kPatience * rate, kLeast, kMost);
}

void HttpInput::begin_transfer(std::uint64_t hole) {
  requested_ = ranges_ == Ranges::kNo ? 0 : hole;
  arriving_ = requested_;
  wanted_ = hole;
  transferred_ = 0;
  head_seen_ = false;
  refused_ = false;
  begun_ = Clock::now();
  main_.reset();
  main_ = std::make_unique<HttpTransfer>(
      multi_, HttpRequest{url_, requested_, {}, strong(etag_), options_.connect_timeout},
      [this](const HttpHead& head, std::span<const std::uint8_t> bytes) {
        const std::lock_guard lock(mutex_);
        if (!head_seen_) refused_ = !accept_head(head);
        if (refused_) return HttpTransfer::Verdict::kStop;
        return accept_bytes(bytes) ? HttpTransfer::Verdict::kTake : HttpTransfer::Verdict::kPause;
      });
}

bool HttpInput::accept_bytes(std::span<const std::uint8_t> bytes) {
  if (arriving_ >= reader_ && arriving_ - reader_ >= options_.read_ahead) return false;
  if (size_ && bytes.size() > *size_ - std::min(*size_, arriving_)) {
    bytes = bytes.first(static_cast<std::size_t>(*size_ - std::min(*size_, arriving_)));
  }
  cache_.write(arriving_, bytes, reader_);
  arriving_ += bytes.size();
  transferred_ += bytes.size();
  received_ += bytes.size();
  if (arriving_ > wanted_) {
    attempts_ = 0;
    reason_.clear();
  }
  news_.notify_all();
  return true;
}

/// Whether the response is one whose body can be used; if not, says why or sees to another attempt.
bool HttpInput::accept_head(const HttpHead& head) {
  head_seen_ = true;
  if (head.status == 200) {
    if (received_ > 0 && !same_resource(head)) return false;
    if (requested_ > 0 || head.refuses_ranges) ranges_ = Ranges::kNo;
    requested_ = arriving_ = 0;
    if (etag_.empty()) etag_ = head.etag;
    if (!size_) size_ = head.content_length;
    live_ = !size_;
    return true;
  }
  if (head.status == 206) {
    if (head.range_first != requested_) {
      give_up("the server sends other bytes than those asked for", false);
      return false;
    }
    ranges_ = Ranges::kYes;
    return same_resource(head);
  }
  if (head.status == 416) {
    give_up(fmt::format("has changed meanwhile: there is no byte {} any more", requested_), false);
  } else if (worth_retrying(head.status)) {
    retry(fmt::format("the server answers with status {}", head.status));
  } else {
    give_up(fmt::format("the server answers with status {}{}", head.status,
                        head.status == 404 ? " (not found)" : ""),
            false);
  }
  return false;
}

bool HttpInput::same_resource(const HttpHead& head) {
  const std::optional<std::uint64_t> total = head.status == 206 ? head.range_total : head.content_length;
  const bool other_tag = !etag_.empty() && !head.etag.empty() && head.etag != etag_;
  const bool other_size = size_ && total && *total != *size_;
  if (!other_tag && !other_size) return true;
  give_up("has changed meanwhile: open it anew", false);
  return false;
}

void HttpInput::check_stalls() {
  const Clock::time_point now = Clock::now();
  const auto stalled = [&](const HttpTransfer& transfer) {
    return !transfer.paused() && now - transfer.last_sign() > options_.stall_timeout;
  };
  const auto seconds = std::chrono::duration<double>(options_.stall_timeout).count();
  if (main_ && stalled(*main_)) {
    main_.reset();
    retry(fmt::format("nothing has come for {:g} s", seconds));
  }
  if (aside_ && aside_->transfer && stalled(*aside_->transfer)) finish_aside(CURLE_OPERATION_TIMEDOUT);
}

void HttpInput::finish_transfers() {
  int left = 0;
  while (const CURLMsg* message = curl_multi_info_read(multi_, &left)) {
    if (message->msg != CURLMSG_DONE) continue;
    const CURL* const handle = message->easy_handle;
    const CURLcode code = message->data.result;
    const std::lock_guard lock(mutex_);
    if (main_ && main_->handle() == handle) {
      finish_main(code);
    } else if (aside_ && aside_->transfer && aside_->transfer->handle() == handle) {
      finish_aside(code);
    }
  }
}

void HttpInput::finish_main(int code) {
  const auto result = static_cast<CURLcode>(code);
  const std::unique_ptr<HttpTransfer> done = std::move(main_);
  news_.notify_all();
  if (!head_seen_ && done->head().status != 0) refused_ = !accept_head(done->head());
  if (refused_ || failure_) return;  // dealt with
  if (result == CURLE_OK && live_) size_ = arriving_;
  if (size_ && arriving_ >= *size_) return;
  const std::string reason = result == CURLE_OK ? "the connection was closed early" : done->failure(result);
  if (worth_retrying(result)) {
    retry(reason);
  } else {
    give_up(reason, true);
  }
}

void HttpInput::retry(const std::string& reason) {
  constexpr std::chrono::milliseconds kLongestDelay{8000};
  if (live_) {  // what follows is another stream: the reader must know
    retry_at_ = Clock::now() + options_.first_delay;
    give_up(fmt::format("the live stream broke off: {}", reason), true);
    return;
  }
  ++attempts_;
  const int allowed = received_ > 0 ? options_.attempts : (options_.attempts + 1) / 2;
  if (attempts_ >= allowed) {
    give_up(fmt::format("{} ({} attempts)", reason, attempts_), true);
    return;
  }
  reason_ = fmt::format("{}: {}; trying again", name_, reason);
  retry_at_ =
      Clock::now() + std::min(kLongestDelay, options_.first_delay * (1 << std::min(attempts_ - 1, 16)));
}

void HttpInput::give_up(const std::string& reason, bool may_try_again) {
  failure_ = input_error(name_, reason);
  may_try_again_ = may_try_again;
  reason_.clear();
  news_.notify_all();
}

void HttpInput::begin_aside() {
  if (!aside_ || aside_->transfer || aside_->done) return;
  Aside& aside = *aside_;
  const ByteRange range = aside.range;
  aside.transfer = std::make_unique<HttpTransfer>(
      multi_,
      HttpRequest{url_, range.offset, range.offset + range.size - 1, strong(etag_), options_.connect_timeout},
      [this, range](const HttpHead& head, std::span<const std::uint8_t> bytes) {
        const std::lock_guard lock(mutex_);
        const bool fits = head.status == 206 && head.range_first == range.offset &&
                          (!head.range_total || head.range_total == size_) && aside_ &&
                          bytes.size() <= range.size - aside_->bytes.size();
        if (head.status == 200) ranges_ = Ranges::kNo;
        if (!fits) return HttpTransfer::Verdict::kStop;
        aside_->bytes.insert(aside_->bytes.end(), bytes.begin(), bytes.end());
        received_ += bytes.size();
        return HttpTransfer::Verdict::kTake;
      });
}

void HttpInput::finish_aside(int code) {
  const auto result = static_cast<CURLcode>(code);
  const std::shared_ptr<Aside> aside = std::move(aside_);
  if (result != CURLE_OK || aside->bytes.size() != aside->range.size) {
    aside->failure = input_error(name_, aside->transfer->failure(result));
  }
  aside->transfer.reset();
  aside->done = true;
  news_.notify_all();
}

}  // namespace tvg::player
