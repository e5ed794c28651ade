#pragma once
#include "modes/gop_encoder.hpp"

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

/// Runs of frames on their way: encoded by several threads at a time, given back in the order they were
/// added. One thread adds and takes.
class GopQueue {
 public:
  /// Encodes a GOP to its chunk; owns what it needs, which is freed as soon as it has run.
  using Work = std::function<Result<EncodedRun>()>;

  /// With one thread a GOP is encoded by whoever adds it.
  explicit GopQueue(unsigned threads) : threads_(threads) {}
  GopQueue(const GopQueue&) = delete;
  GopQueue& operator=(const GopQueue&) = delete;
  ~GopQueue();

  /// Adds a GOP. Where that is full(), take() first.
  void add(Work work);

  /// Whether more would only take memory: the threads are busy and one GOP waits, or so many are encoded and
  /// wait for one before them.
  bool full();
  /// The oldest GOP, if it is encoded.
  std::optional<Result<EncodedRun>> take() {
    return take_when([] { return true; });
  }
  /// The same, but waits until it is, or until there is room for another.
  std::optional<Result<EncodedRun>> take_or_make_room() {
    return take_when([this] { return front_done() || !full_now(); });
  }
  /// The same, but waits until it is; nothing only where there is none.
  std::optional<Result<EncodedRun>> take_next() {
    return take_when([this] { return front_done(); });
  }

 private:
  struct Entry {
    Work work;
    std::optional<Result<EncodedRun>> run;
  };

  template <class Ready>
  std::optional<Result<EncodedRun>> take_when(Ready ready) {
    std::unique_lock lock(mutex_);
    if (entries_.empty()) return std::nullopt;
    work_done_.wait(lock, ready);
    if (!front_done()) return std::nullopt;
    Result<EncodedRun> done = std::move(*entries_.front().run);
    entries_.pop_front();
    return done;
  }
  bool front_done() const { return entries_.front().run.has_value(); }
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
