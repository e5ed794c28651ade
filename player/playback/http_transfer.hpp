#pragma once
#include <chrono>
#include <cstdint>
#include <curl/curl.h>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tvg::player {

/// What a transfer asks for.
struct HttpRequest {
  std::string url;
  std::uint64_t offset = 0;           ///< first byte wanted
  std::optional<std::uint64_t> last;  ///< last byte wanted; the end of the resource where absent
  std::string validator;  ///< an ETag: where the resource is not that any more, all of it comes; may be empty
  std::chrono::milliseconds connect_timeout{0};
};

/// What the head of the response says; that of the last one, after redirects.
struct HttpHead {
  long status = 0;
  std::optional<std::uint64_t> content_length;
  std::optional<std::uint64_t> range_first;  ///< of Content-Range
  std::optional<std::uint64_t> range_total;
  std::string etag;
  bool refuses_ranges = false;

  void read_line(std::string_view line);
};

/// One request and its response, run by a curl multi handle. Belongs to the thread that runs that.
class HttpTransfer {
 public:
  enum class Verdict { kTake, kPause, kStop };
  using Clock = std::chrono::steady_clock;

  /// Starts the request. `take` gets the body piece by piece and says what to do; a piece that meets kPause
  /// comes again after resume(). The multi handle must outlive the transfer.
  HttpTransfer(CURLM* multi, const HttpRequest& request,
               std::function<Verdict(const HttpHead&, std::span<const std::uint8_t>)> take);
  ~HttpTransfer();
  HttpTransfer(const HttpTransfer&) = delete;
  HttpTransfer& operator=(const HttpTransfer&) = delete;

  CURL* handle() const { return easy_.get(); }
  const HttpHead& head() const { return head_; }
  bool paused() const { return paused_; }
  void resume();
  /// When something last came, or the transfer began or went on.
  Clock::time_point last_sign() const { return last_sign_; }
  /// What curl says of the failure `code`.
  std::string failure(CURLcode code) const;

 private:
  static std::size_t on_header(char* data, std::size_t size, std::size_t count, void* self);
  static std::size_t on_body(char* data, std::size_t size, std::size_t count, void* self);

  struct EasyDeleter {
    void operator()(CURL* easy) const { curl_easy_cleanup(easy); }
  };
  struct ListDeleter {
    void operator()(curl_slist* list) const { curl_slist_free_all(list); }
  };

  CURLM* multi_;
  std::unique_ptr<CURL, EasyDeleter> easy_;
  std::unique_ptr<curl_slist, ListDeleter> headers_;
  std::function<Verdict(const HttpHead&, std::span<const std::uint8_t>)> take_;
  HttpHead head_;
  bool paused_ = false;
  bool out_of_memory_ = false;
  Clock::time_point last_sign_;
  char error_[CURL_ERROR_SIZE] = {};
};

}  // namespace tvg::player
