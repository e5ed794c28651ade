#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tvg::player {

/// Says which frame is to be shown at a time. It stands still while it is paused, and while the frame it
/// wants is not there; then it goes on from that frame. Times are in seconds, from any point on, and never
/// go back.
class PlaybackClock {
 public:
  static constexpr double kDefaultRate = 30;
  static constexpr double kSlowest = 0.1;
  static constexpr double kFastest = 4;
  /// A wait that is shorter than this, in seconds, is no stall: nobody sees it.
  static constexpr double kNoticed = 0.1;

  double rate() const { return rate_; }
  double speed() const { return speed_; }
  bool playing() const { return playing_; }
  bool looping() const { return looping_; }
  /// Frames per second of the stream.
  void set_rate(double rate, double now);
  /// When frames are, in seconds, where they are not evenly spaced: times that rise, of the first frames;
  /// those behind them follow at the rate.
  void set_times(std::vector<double> times, double now);
  /// Times the stream's rate; clamped to kSlowest..kFastest.
  void set_speed(double speed, double now);
  /// The frames played: `first` to `last`, where the latter is known. When looping, `first` follows `last`;
  /// otherwise the clock pauses at `last`.
  void set_range(std::uint64_t first, std::optional<std::uint64_t> last);
  void set_looping(bool looping) { looping_ = looping; }

  /// Goes on; from the range's first frame where the last one is reached and nothing loops.
  void play(double now);
  void pause(double now);
  /// Goes to a frame; clamped to the range.
  void seek(std::uint64_t frame, double now);
  /// Pauses, and goes `count` frames on (back where it is negative): around the ends when looping.
  void step(std::int64_t count, double now);

  /// The frame that is to be shown at `now`.
  std::uint64_t frame(double now);
  /// The frame asked for is shown. Frames passed over since the last one count as dropped, at normal speed or
  /// less.
  void shown();
  /// The frame asked for is not there: the clock stands until resume().
  void wait(double now);
  bool waiting() const { return waiting_; }
  /// Seconds since wait().
  double waited(double now) const { return waiting_ ? now - waiting_since_ : 0; }
  void resume(double now);

  std::uint64_t dropped() const { return dropped_; }
  /// Frames that were not there in time while playing, other than the first one and after seek().
  std::uint64_t late() const { return late_; }
  /// Those among them that were waited for noticeably.
  std::uint64_t stalls() const { return stalls_; }
  /// By how much playing took longer for all of them.
  double waited_seconds() const { return waited_seconds_; }

 private:
  double position(double now) const;
  void anchor(double position, double now);
  bool moving() const { return playing_ && !waiting_; }
  std::uint64_t clamped(std::uint64_t frame) const;

  double rate_ = kDefaultRate;
  std::vector<double> times_;
  double speed_ = 1;
  bool playing_ = false;
  bool looping_ = false;
  std::uint64_t first_ = 0;
  std::optional<std::uint64_t> last_;
  double anchor_position_ = 0;  ///< in frames, at anchor_time_
  double anchor_time_ = 0;
  std::uint64_t wanted_ = 0;
  std::optional<std::uint64_t> shown_;  ///< since the last seek
  bool waiting_ = false;
  bool is_stall_ = false;  ///< that wait interrupts what was moving
  double waiting_since_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t stalls_ = 0;
  std::uint64_t late_ = 0;
  double waited_seconds_ = 0;
};

}  // namespace tvg::player
