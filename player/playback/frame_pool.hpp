#pragma once
#include "player/playback/player_frame.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace tvg::cli {

/// Frames that are used again and again, so that playing allocates nothing. Used by one thread; what it gave
/// out may be released by any.
class FramePool {
 public:
  /// Gives out at most `limit` frames at a time.
  void set_limit(std::size_t limit) { limit_ = limit; }
  /// Whether take() would succeed.
  bool has_free() const;
  /// A frame that nobody else holds, its contents left over; null where all are in use.
  std::shared_ptr<PlayerFrame> take();
  /// Gives back the memory of frames that nobody holds.
  void drop_free();
  /// Frames made and kept, in use or not.
  std::size_t size() const { return frames_.size(); }

 private:
  std::vector<std::shared_ptr<PlayerFrame>> frames_;
  std::size_t limit_ = 4;
};

}  // namespace tvg::cli
