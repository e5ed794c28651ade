#pragma once
#include "player/playback/bell.hpp"
#include "player/playback/player_frame.hpp"

#include <cstddef>
#include <memory>

namespace tvg::player {

/// Frames that are used again and again, so that playing allocates next to nothing. Used by one thread; what
/// it gave out may be released by any, also after the pool has gone.
class FramePool {
 public:
  /// `bell` is rung when a frame that was given out is free again.
  explicit FramePool(std::shared_ptr<Bell> bell);

  /// Gives out at most `limit` frames at a time.
  void set_limit(std::size_t limit) { limit_ = limit; }
  /// Whether take() would succeed.
  bool has_free() const;
  /// A frame that nobody else holds, its contents left over; null where all are in use.
  std::shared_ptr<PlayerFrame> take();
  /// Gives back the memory of frames that nobody holds.
  void drop_free();
  /// Frames made and kept, in use or not.
  std::size_t size() const { return made_; }

 private:
  class Shelf;

  std::shared_ptr<Shelf> shelf_;
  std::size_t made_ = 0;
  std::size_t limit_ = 4;
};

}  // namespace tvg::player
