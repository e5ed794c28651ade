#pragma once
#include "player/playback/playback_clock.hpp"
#include "player/playback/stream_loader.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tvg::player {

struct PlayerOptions {
  LoaderOptions loader;
  bool playing = true;  ///< from the start
  bool looping = true;
  std::optional<double> rate;  ///< frames per second, instead of what the metadata say
};

/// What a window shows of a player beside the frame; a copy that may be kept.
struct PlayerSnapshot {
  enum class Status {
    kOpening,    ///< nothing can be shown yet
    kBuffering,  ///< the frame wanted is not there yet; the last one stays
    kReady,
    kEnded,   ///< paused at the last frame
    kFailed,  ///< stream.message says why; frames decoded before can still be shown
  };

  Status status = Status::kOpening;
  LoaderSnapshot stream;
  std::uint64_t frame = 0;  ///< number that is to be shown
  bool held = false;        ///< that frame is lost, another one stands in for it
  bool playing = false;
  bool looping = false;
  std::optional<LoopRange> range;  ///< set by the user
  double rate = PlaybackClock::kDefaultRate;
  double speed = 1;
  std::uint64_t dropped = 0;
  std::uint64_t late = 0;  ///< frames that were not there in time; see PlaybackClock
  std::uint64_t stalls = 0;
  double waited_seconds = 0;
  double bits_per_second = 0;  ///< of the stream around the frame shown, at its rate; 0 where not known
};

/// Plays a stream: says which frame to show now. For one thread; nothing in it waits. Times are in seconds,
/// as PlaybackClock has them.
class Player {
 public:
  explicit Player(std::unique_ptr<StreamInput> input, const PlayerOptions& options = {});

  /// The frame to show at `now`: the last one again while the one wanted is not there, null before the
  /// first. To be called for every picture.
  std::shared_ptr<const PlayerFrame> update(double now);

  void play(double now);
  void pause(double now);
  void toggle(double now) { clock_.playing() ? pause(now) : play(now); }
  /// Goes to a frame, clamped to the range; playing goes on from there.
  void seek(std::uint64_t frame, double now);
  /// Pauses and goes `count` frames on, or back where it is negative.
  void step(std::int64_t count, double now);
  void set_speed(double speed, double now);
  void set_looping(bool looping);
  /// Plays frames of this range only; of the whole stream where absent.
  void set_range(std::optional<LoopRange> range, double now);
  /// See FrameDecorator; null for none. The frame shown comes again, decorated.
  void set_decorator(std::shared_ptr<FrameDecorator> decorator, double now);

  PlayerSnapshot snapshot() const;
  /// Packet sizes of frames `first` to `last`, as far as they were met lately.
  std::vector<FrameBytes> frame_bytes(std::uint64_t first, std::uint64_t last) const {
    return loader_.frame_bytes(first, last);
  }

 private:
  void follow_stream();
  void adopt_rate(double now);
  bool ready_to_go(const StreamLoader::Supply& supply, double now) const;
  void go_to(std::uint64_t frame, std::uint64_t lead_in);
  void tell_loop();
  void set_clock_range();

  StreamLoader loader_;
  PlaybackClock clock_;
  std::optional<double> forced_rate_;
  std::optional<LoopRange> range_;
  std::optional<std::uint64_t> frame_count_;
  bool primed_ = false;                  ///< enough was there to begin, since the last seek
  bool missing_ = true;                  ///< the frame wanted is not there
  std::optional<std::uint64_t> sought_;  ///< by update() itself: once for each frame
  std::shared_ptr<const PlayerFrame> frame_;
  std::uint64_t wanted_ = 0;
};

}  // namespace tvg::player
