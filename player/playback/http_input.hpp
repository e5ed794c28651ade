#pragma once
#include "player/playback/block_cache.hpp"
#include "player/playback/stream_input.hpp"

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

namespace tvg::player {

class HttpTransfer;
struct HttpHead;

struct HttpOptions {
  std::uint64_t cache_bytes = std::uint64_t{256} << 20;  ///< kept of what has come
  std::uint64_t read_ahead = std::uint64_t{64} << 20;    ///< fetched before it is asked for
  std::chrono::milliseconds connect_timeout{10'000};
  std::chrono::milliseconds stall_timeout{10'000};  ///< without a byte; then the connection is made anew
  int attempts = 6;  ///< in a row without a new byte, before giving up; half as many before the first byte
  std::chrono::milliseconds first_delay{250};  ///< before the second attempt; doubles with each, up to 8 s
};

/// A resource on an HTTP server. Bytes are fetched ahead of the reader by one transfer, which is begun anew
/// with a range where the reader goes elsewhere or the connection breaks. A server that knows no ranges is
/// read front to back. A response without a length is a live stream: it is never resumed, since what comes
/// next is another stream.
class HttpInput final : public StreamInput {
 public:
  explicit HttpInput(std::string url, const HttpOptions& options = {});
  ~HttpInput() override;
  HttpInput(const HttpInput&) = delete;
  HttpInput& operator=(const HttpInput&) = delete;

  /// The URL without user and password.
  const std::string& name() const override { return name_; }
  std::optional<std::uint64_t> size() const override;
  Result<std::size_t> read(std::uint64_t offset, std::span<std::uint8_t> target) override;
  Result<std::vector<std::uint8_t>> read_aside(const ByteRange& range) override;
  bool reaches(std::uint64_t offset) const override;
  bool begin_anew() override;
  void interrupt() override;
  void resume() override;
  void cancel() override;
  std::vector<ByteRange> buffered() const override;
  InputStatus status() const override;

 private:
  using Clock = std::chrono::steady_clock;
  enum class Ranges { kUnknown, kYes, kNo };

  /// A range fetched beside the main transfer.
  struct Aside {
    ByteRange range;
    std::vector<std::uint8_t> bytes;
    std::unique_ptr<HttpTransfer> transfer;
    std::optional<Error> failure;
    bool done = false;
  };

  // Of the worker thread; those that plan and take bytes hold the lock.
  void run();
  bool work();
  bool plan();
  void begin_transfer(std::uint64_t hole);
  bool on_the_way(std::uint64_t hole) const;
  void check_stalls();
  void finish_transfers();
  void finish_main(int code);
  void finish_aside(int code);
  bool accept_head(const HttpHead& head);
  bool same_resource(const HttpHead& head);
  bool accept_bytes(std::span<const std::uint8_t> bytes);
  void begin_aside();
  void retry(const std::string& reason);
  void give_up(const std::string& reason, bool may_try_again);
  std::chrono::milliseconds time_to_wait() const;
  void wake();

  const std::string url_;
  const std::string name_;
  const HttpOptions options_;
  void* const multi_;  ///< curl's

  mutable std::mutex mutex_;
  std::condition_variable news_;  ///< for readers
  BlockCache cache_;
  std::vector<std::uint8_t> tail_;  ///< the last bytes of the resource, once they were fetched
  std::uint64_t reader_ = 0;        ///< where read() goes on
  std::optional<std::uint64_t> size_;
  std::string etag_;
  Ranges ranges_ = Ranges::kUnknown;
  bool head_seen_ = false;  ///< of the main transfer's response, since it was begun
  bool refused_ = false;    ///< that response cannot be used
  bool live_ = false;
  std::optional<Error> failure_;
  bool may_try_again_ = false;  ///< after failure_, when the user goes elsewhere
  bool interrupted_ = false;
  bool cancelled_ = false;
  std::shared_ptr<Aside> aside_;
  std::uint64_t received_ = 0;
  std::string reason_;  ///< of the last failed attempt, until bytes come

  std::unique_ptr<HttpTransfer> main_;
  std::uint64_t requested_ = 0;  ///< offset the main transfer asked for
  std::uint64_t arriving_ = 0;   ///< offset of the next byte it brings
  std::uint64_t wanted_ = 0;     ///< bytes from here on are news
  std::uint64_t transferred_ = 0;
  Clock::time_point begun_{};
  Clock::time_point retry_at_{};
  int attempts_ = 0;

  std::thread thread_;
};

}  // namespace tvg::player
