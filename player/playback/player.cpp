#include "player/playback/player.hpp"

#include "tool/option_values.hpp"

#include <algorithm>
#include <utility>

namespace tvg::player {

namespace {

// Decoded frames that must be there before time runs: after a seek few, so that it moves soon; after a stall
// more, so that it does not stall again at once. In seconds of the stream.
constexpr double kSupplyAtStart = 0.1;
constexpr double kSupplyAfterStall = 0.7;
// Frames before the one shown that a step back decodes with it, for the steps that follow.
constexpr std::uint64_t kLeadIn = 12;

}  // namespace

Player::Player(std::unique_ptr<StreamInput> input, const PlayerOptions& options)
    : loader_(std::move(input), options.loader), forced_rate_(options.rate) {
  clock_.set_looping(options.looping);
  if (options.playing) clock_.play(0);
  clock_.wait(0);
  tell_loop();
}

std::shared_ptr<const PlayerFrame> Player::update(double now) {
  follow_stream();
  wanted_ = clock_.frame(now);
  std::shared_ptr<const PlayerFrame> frame = loader_.show(wanted_);
  missing_ = frame == nullptr;
  const StreamLoader::Supply supply = loader_.supply();
  if (frame) {
    adopt_rate(now);
    frame_ = std::move(frame);
    sought_.reset();
    if (!primed_ || clock_.waiting()) {
      if (ready_to_go(supply, now)) {
        primed_ = true;
        clock_.resume(now);
      } else {
        clock_.wait(now);
      }
    }
    clock_.shown();
    return frame_;
  }
  clock_.wait(now);
  if (supply.failed) {
    clock_.pause(now);
  } else if (!loader_.heads_for(wanted_) && sought_ != wanted_) {
    sought_ = wanted_;
    loader_.seek(wanted_);
  }
  return frame_;
}

/// Takes over what has become known of the stream.
void Player::follow_stream() {
  const StreamLoader::Supply supply = loader_.supply();
  if (!supply.can_go_back) clock_.set_looping(false);
  if (supply.frame_count == frame_count_) return;
  frame_count_ = supply.frame_count;
  set_clock_range();
}

/// With the first frame the metadata are there.
void Player::adopt_rate(double now) {
  if (frame_) return;
  const LoaderSnapshot stream = loader_.snapshot();
  const Metadata& metadata = stream.metadata;
  const auto fps = metadata.find("fps");
  const std::optional<double> rate =
      fps == metadata.end() ? std::nullopt : cli::parse_frame_rate(fps->second);
  clock_.set_rate(forced_rate_.value_or(rate.value_or(PlaybackClock::kDefaultRate)), now);
  if (!forced_rate_) clock_.set_times(stream.times, now);
}

bool Player::ready_to_go(const StreamLoader::Supply& supply, double now) const {
  if (supply.complete || (primed_ && clock_.waited(now) < PlaybackClock::kNoticed)) return true;
  const double seconds = (primed_ ? kSupplyAfterStall : kSupplyAtStart) * clock_.speed();
  return static_cast<double>(supply.ahead) >= seconds * clock_.rate();
}

void Player::play(double now) {
  const std::uint64_t before = clock_.frame(now);
  clock_.play(now);
  if (clock_.frame(now) != before) go_to(clock_.frame(now), 0);
}

void Player::pause(double now) {
  clock_.pause(now);
}

void Player::seek(std::uint64_t frame, double now) {
  clock_.seek(frame, now);
  go_to(clock_.frame(now), 0);
}

void Player::step(std::int64_t count, double now) {
  clock_.step(count, now);
  go_to(clock_.frame(now), count < 0 ? kLeadIn : 0);
}

void Player::go_to(std::uint64_t frame, std::uint64_t lead_in) {
  primed_ = false;
  sought_.reset();
  loader_.seek(frame, lead_in);
}

void Player::set_speed(double speed, double now) {
  clock_.set_speed(speed, now);
}

void Player::set_looping(bool looping) {
  clock_.set_looping(looping);
  tell_loop();
}

void Player::set_range(std::optional<LoopRange> range, double now) {
  range_ = range;
  set_clock_range();
  tell_loop();
  const std::uint64_t before = clock_.frame(now);
  clock_.seek(before, now);
  if (clock_.frame(now) != wanted_) go_to(clock_.frame(now), 0);
}

void Player::set_clock_range() {
  const std::uint64_t first = range_ ? range_->first : 0;
  std::optional<std::uint64_t> last = range_ ? range_->last : std::nullopt;
  if (frame_count_ && *frame_count_ > 0) last = std::min(last.value_or(*frame_count_ - 1), *frame_count_ - 1);
  clock_.set_range(first, last);
}

void Player::tell_loop() {
  if (clock_.looping()) {
    loader_.set_loop(range_.value_or(LoopRange{}));
  } else {
    loader_.set_loop(std::nullopt);
  }
}

void Player::set_decorator(std::shared_ptr<FrameDecorator> decorator, double now) {
  clock_.seek(clock_.frame(now), now);
  wanted_ = clock_.frame(now);
  primed_ = false;
  loader_.set_decorator(std::move(decorator), wanted_);
}

PlayerSnapshot Player::snapshot() const {
  PlayerSnapshot snapshot;
  snapshot.stream = loader_.snapshot();
  snapshot.frame = wanted_;
  snapshot.held = frame_ && !missing_ && frame_->number != wanted_;
  snapshot.playing = clock_.playing();
  snapshot.looping = clock_.looping();
  snapshot.range = range_;
  snapshot.rate = clock_.rate();
  snapshot.speed = clock_.speed();
  snapshot.dropped = clock_.dropped();
  snapshot.stalls = clock_.stalls();
  snapshot.late = clock_.late();
  snapshot.waited_seconds = clock_.waited_seconds();
  if (frame_ && frame_->gop->info.frame_count > 0) {
    snapshot.bits_per_second =
        8 * static_cast<double>(frame_->gop->info.bytes) / frame_->gop->info.frame_count * clock_.rate();
  }
  using Status = PlayerSnapshot::Status;
  const bool at_end = frame_count_ && wanted_ + 1 >= *frame_count_;
  if (snapshot.stream.state == LoaderSnapshot::State::kFailed) {
    snapshot.status = Status::kFailed;
  } else if (!frame_) {
    snapshot.status = Status::kOpening;
  } else if (missing_ || (clock_.playing() && clock_.waiting())) {
    snapshot.status = Status::kBuffering;
  } else if (!clock_.playing() && at_end && !clock_.looping()) {
    snapshot.status = Status::kEnded;
  } else {
    snapshot.status = Status::kReady;
  }
  return snapshot;
}

}  // namespace tvg::player
