#include "player/playback/playback_clock.hpp"

#include "tool/frame_times.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tvg::player {

double PlaybackClock::position(double now) const {
  if (!moving()) return anchor_position_;
  const double passed = std::max(0.0, now - anchor_time_) * speed_;
  if (times_.empty()) return anchor_position_ + passed * rate_;
  const cli::FrameTimeline line(times_, rate_);
  return line.frame_at(line.time_at(anchor_position_) + passed);
}

void PlaybackClock::anchor(double position, double now) {
  anchor_position_ = position;
  anchor_time_ = now;
}

std::uint64_t PlaybackClock::clamped(std::uint64_t frame) const {
  return std::max(first_, last_ ? std::min(frame, *last_) : frame);
}

void PlaybackClock::set_rate(double rate, double now) {
  anchor(position(now), now);
  rate_ = rate;
}

void PlaybackClock::set_times(std::vector<double> times, double now) {
  anchor(position(now), now);
  times_ = std::move(times);
}

void PlaybackClock::set_speed(double speed, double now) {
  anchor(position(now), now);
  speed_ = std::clamp(speed, kSlowest, kFastest);
}

void PlaybackClock::set_range(std::uint64_t first, std::optional<std::uint64_t> last) {
  first_ = first;
  last_ = last;
  if (last_ && *last_ < first_) last_ = first_;
}

void PlaybackClock::play(double now) {
  if (playing_) return;
  if (!looping_ && last_ && wanted_ >= *last_) seek(first_, now);
  anchor(anchor_position_, now);
  playing_ = true;
}

void PlaybackClock::pause(double now) {
  anchor(static_cast<double>(frame(now)), now);
  playing_ = false;
}

void PlaybackClock::seek(std::uint64_t frame, double now) {
  wanted_ = clamped(frame);
  anchor(static_cast<double>(wanted_), now);
  shown_.reset();
  waiting_ = false;
}

void PlaybackClock::step(std::int64_t count, double now) {
  pause(now);
  std::uint64_t target = wanted_;
  if (count < 0) {
    const auto back = static_cast<std::uint64_t>(-count);
    const bool around = looping_ && last_ && wanted_ < first_ + back;
    target = around ? *last_ : wanted_ - std::min(back, wanted_);
  } else {
    target = wanted_ + static_cast<std::uint64_t>(count);
    if (looping_ && last_ && target > *last_) target = first_;
  }
  seek(target, now);
}

std::uint64_t PlaybackClock::frame(double now) {
  // Rounding must not give a picture at the very time of a frame the one before.
  constexpr double kRounding = 1e-6;
  double at = position(now);
  const auto first = static_cast<double>(first_);
  if (last_ && at + kRounding >= static_cast<double>(*last_) + 1) {
    const auto length = static_cast<double>(*last_ - first_ + 1);
    if (looping_) {
      at = first + std::max(0.0, std::fmod(at + kRounding - first, length) - kRounding);
      anchor(at, now);
    } else {
      at = static_cast<double>(*last_);
      anchor(at, now);
      playing_ = false;
    }
  }
  if (at < first) {
    at = first;
    anchor(at, now);
  }
  wanted_ = static_cast<std::uint64_t>(at + kRounding);
  if (last_) wanted_ = std::min(wanted_, *last_);
  return wanted_;
}

void PlaybackClock::shown() {
  if (shown_ && playing_ && speed_ <= 1 && wanted_ != *shown_) {
    const bool around = wanted_ < *shown_ && last_ && *shown_ <= *last_;
    if (wanted_ > *shown_) dropped_ += wanted_ - *shown_ - 1;
    if (around) dropped_ += *last_ - *shown_ + wanted_ - first_;
  }
  shown_ = wanted_;
}

void PlaybackClock::wait(double now) {
  if (waiting_) return;
  anchor(static_cast<double>(frame(now)), now);
  waiting_ = true;
  waiting_since_ = now;
  is_stall_ = playing_ && shown_.has_value();
}

void PlaybackClock::resume(double now) {
  if (!waiting_) return;
  const double time = waited(now);
  if (playing_ && is_stall_) {
    ++late_;
    stalls_ += time >= kNoticed ? 1 : 0;
    waited_seconds_ += time;
  }
  waiting_ = false;
  anchor(static_cast<double>(wanted_), now);
}

}  // namespace tvg::player
