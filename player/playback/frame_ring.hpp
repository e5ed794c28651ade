#pragma once
#include "player/playback/player_frame.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace tvg::player {

/// A run of frames: `count` of them from `first` on.
struct FrameRun {
  std::uint64_t first = 0;
  std::uint64_t count = 0;

  bool operator==(const FrameRun&) const = default;
};

/// Decoded frames in the order in which they will be shown, around the one that is shown now. Numbers rise,
/// but for loops, where they begin again. A number that is missing between two frames is one that was lost:
/// the frame before stands in for it, and the first frame for those lost before it.
class FrameRing {
 public:
  /// Holds at most `capacity` frames, at least 2; a quarter of them stays behind the one shown.
  explicit FrameRing(std::size_t capacity) { set_capacity(capacity); }

  /// A smaller capacity takes effect as frames are shown.
  void set_capacity(std::size_t capacity);
  std::size_t capacity() const { return capacity_; }
  std::size_t size() const { return entries_.size(); }

  /// Drops everything. The next frame pushed stands in for those from `first` on.
  void reset(std::uint64_t first);
  /// Whether push() may be called: there is space, or a frame that is behind far enough.
  bool has_room() const;
  /// Adds the frame that follows. Needs has_room().
  void push(std::shared_ptr<const PlayerFrame> frame);
  /// `count` frames from `first` on are lost: where they follow the last frame, it stands in for them.
  void pass_over(std::uint64_t first, std::uint64_t count);
  /// The stream or the loop ends before frame `end`: the last frame stands in for the rest. The next frame
  /// pushed stands in for those from `next` on.
  void close(std::uint64_t end, std::uint64_t next);

  /// The frame for `number`, which becomes the one shown: in a short loop, where the ring holds it more than
  /// once, the nearest. Null where there is none; frames that come before it then count as shown.
  std::shared_ptr<const PlayerFrame> show(std::uint64_t number);
  /// Whether show() would find one.
  bool contains(std::uint64_t number) const;
  /// Frames after the one shown.
  std::size_t ahead() const;
  /// Number of the frame that the next push() is expected to bring.
  std::uint64_t next() const { return next_; }
  /// The frame numbers that can be shown, in ascending order and without overlap.
  std::vector<FrameRun> runs() const;

 private:
  struct Entry {
    std::shared_ptr<const PlayerFrame> frame;
    std::uint64_t from;  ///< first and last number it can be shown for
    std::uint64_t to;
  };

  std::size_t find(std::uint64_t number) const;
  std::size_t behind_limit() const { return capacity_ / 4; }

  std::deque<Entry> entries_;
  std::size_t capacity_ = 2;
  std::size_t shown_ = 0;   ///< index of the entry shown; entries_.size() where it is none of them
  bool continues_ = false;  ///< the next frame follows the last entry, with no end of a loop in between
  std::uint64_t next_ = 0;
};

}  // namespace tvg::player
