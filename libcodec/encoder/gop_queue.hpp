#pragma once
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

using GopChunk = std::vector<std::uint8_t>;

/// GOPs on their way: encoded by several threads at a time, given back in the order they were added. One
/// thread adds and takes.
class GopQueue {
 public:
  /// Encodes a GOP to its chunk; owns what it needs, which is freed as soon as it has run.
  using Work = std::function<Result<GopChunk>()>;

  /// A GOP that is encoded.
  struct Done {
    std::uint32_t frame_count = 0;
    Result<GopChunk> chunk;
  };

  /// With one thread a GOP is encoded by whoever adds it.
  explicit GopQueue(unsigned threads) : threads_(threads) {}
  GopQueue(const GopQueue&) = delete;
  GopQueue& operator=(const GopQueue&) = delete;
  ~GopQueue();

  /// Adds a GOP. Where that is full(), take() first.
  void add(std::uint32_t frame_count, Work work);

  /// Whether more would only take memory: the threads are busy and one GOP waits, or so many are encoded and
  /// wait for one before them.
  bool full();
  /// The oldest GOP, if it is encoded.
  std::optional<Done> take() {
    return take_when([] { return true; });
  }
  /// The same, but waits until it is, or until there is room for another.
  std::optional<Done> take_or_make_room() {
    return take_when([this] { return front_done() || !full_now(); });
  }
  /// The same, but waits until it is; nothing only where there is none.
  std::optional<Done> take_next() {
    return take_when([this] { return front_done(); });
  }

 private:
  struct Entry {
    std::uint32_t frame_count = 0;
    Work work;
    std::optional<Result<GopChunk>> chunk;
  };

  template <class Ready>
  std::optional<Done> take_when(Ready ready) {
    std::unique_lock lock(mutex_);
    if (entries_.empty()) return std::nullopt;
    work_done_.wait(lock, ready);
    if (!front_done()) return std::nullopt;
    Done done{entries_.front().frame_count, std::move(*entries_.front().chunk)};
    entries_.pop_front();
    return done;
  }
  bool front_done() const { return entries_.front().chunk.has_value(); }
  bool full_now() const;
  void start_thread();
  void run();

  const unsigned threads_;
  std::mutex mutex_;
  std::condition_variable work_added_, work_done_;
  std::deque<Entry> entries_;  ///< oldest first; addresses stay
  std::deque<Entry*> waiting_;
  unsigned at_work_ = 0;
  bool closing_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace tvg
