#pragma once
#include <atomic>
#include <cstdint>

namespace tvg::player {

/// Wakes one thread that waits for any of several things. It counts its strokes, so that none is missed
/// between looking and waiting: take strokes(), look whether there is anything to do, wait_beyond() them. May
/// be rung under any lock.
class Bell {
 public:
  void ring() {
    ++strokes_;
    strokes_.notify_all();
  }
  std::uint32_t strokes() const { return strokes_; }
  /// Returns when the bell has been rung since strokes() gave `seen`.
  void wait_beyond(std::uint32_t seen) const { strokes_.wait(seen); }

 private:
  std::atomic<std::uint32_t> strokes_{0};
};

}  // namespace tvg::player
