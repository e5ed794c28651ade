#include "player/playback/player.hpp"

#include "playback_toolbox.hpp"
#include "player/playback/pipe_input.hpp"

#include <gmock/gmock.h>

namespace tvg::test {
namespace {

using player::Player;
using player::PlayerOptions;
using player::PlayerSnapshot;
using Status = PlayerSnapshot::Status;

/// A player whose time passes only while nothing is awaited, so that tests do not depend on speed.
class Playing {
 public:
  explicit Playing(const Stream& stream, const PlayerOptions& options = {})
      : file_(stream), player_(player::open_stream_input(file_.path()), options) {}

  Player& player() { return player_; }
  double now() const { return now_; }

  /// The next picture, `seconds` later, once what it wants is there.
  std::shared_ptr<const player::PlayerFrame> picture(double seconds) {
    now_ += seconds;
    std::shared_ptr<const player::PlayerFrame> frame;
    EXPECT_TRUE(eventually([&] {
      frame = player_.update(now_);
      const Status status = player_.snapshot().status;
      return status != Status::kBuffering && status != Status::kOpening;
    })) << player_.snapshot().stream.message;
    return frame;
  }

 private:
  TemporaryFile file_;
  Player player_;
  double now_ = 1000;
};

TEST(Player, ShowsEveryFrameInOrderAndBeginsAgain) {
  const Stream stream = encoded("toy", 5);
  const DecodedStream plain = decode_stream(stream);
  PlayerOptions options;
  options.loader.ring_frames = 8;
  Playing playing(stream, options);
  for (int f = 0; f < 40; ++f) {
    const auto frame = playing.picture(f == 0 ? 0 : 1.0 / 25);
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->number, static_cast<std::uint64_t>(f % 12)) << f;
    ASSERT_EQ(frame->positions, plain.frames[f % 12].positions);
  }
  const PlayerSnapshot snapshot = playing.player().snapshot();
  EXPECT_EQ(snapshot.rate, 25);
  EXPECT_EQ(snapshot.dropped, 0u);
  EXPECT_EQ(snapshot.stalls, 0u);
  EXPECT_GT(snapshot.bits_per_second, 0);
}

TEST(Player, StopsAtTheEndAndPlaysOnceMore) {
  PlayerOptions options;
  options.looping = false;
  Playing playing(encoded("toy", 5), options);
  std::uint64_t last = 0;
  for (int f = 0; f < 20; ++f) last = playing.picture(1.0 / 25)->number;
  EXPECT_EQ(last, 11u);
  EXPECT_EQ(playing.player().snapshot().status, Status::kEnded);
  playing.player().play(playing.now());
  EXPECT_EQ(playing.picture(0)->number, 0u);
  EXPECT_EQ(playing.picture(1.0 / 25)->number, 1u);
}

TEST(Player, StepsGoToTheNeighbouringFrameHoweverFar) {
  const Stream stream = encoded("cloth", 6);
  const DecodedStream plain = decode_stream(stream);
  PlayerOptions options;
  options.loader.ring_frames = 4;
  options.looping = false;
  Playing playing(stream, options);
  Player& player = playing.player();
  playing.picture(0);
  const std::uint64_t end = plain.frames.size() - 1;
  player.seek(end, playing.now());
  for (std::uint64_t f = end; f > 0; --f) {
    ASSERT_EQ(playing.picture(0.1)->positions, plain.frames[f].positions) << f;
    player.step(-1, playing.now());
  }
  EXPECT_FALSE(player.snapshot().playing);
  for (std::uint64_t f = 0; f <= end; ++f) {
    ASSERT_EQ(playing.picture(0.1)->positions, plain.frames[f].positions) << f;
    player.step(1, playing.now());
  }
}

TEST(Player, PlaysARangeAgainAndAgain) {
  Playing playing(encoded("toy", 5));
  playing.picture(0);
  playing.player().set_range(player::LoopRange{4, 6}, playing.now());
  for (int f = 0; f < 12; ++f) {
    EXPECT_EQ(playing.picture(f == 0 ? 0 : 1.0 / 25)->number, static_cast<std::uint64_t>(4 + f % 3)) << f;
  }
  playing.player().set_range(std::nullopt, playing.now());
  playing.player().seek(9, playing.now());
  EXPECT_EQ(playing.picture(0)->number, 9u);
  EXPECT_EQ(playing.picture(1.0 / 25)->number, 10u);
}

TEST(Player, SpeedAndPauseTakeEffectAtOnce) {
  Playing playing(encoded("toy", 5));
  playing.picture(0);
  playing.player().set_speed(2, playing.now());
  EXPECT_EQ(playing.picture(1.0 / 25)->number, 2u);
  playing.player().pause(playing.now());
  EXPECT_EQ(playing.picture(5)->number, 2u);
  playing.player().toggle(playing.now());
  EXPECT_EQ(playing.picture(1.0 / 25)->number, 4u);
}

TEST(Player, ShowsTheLastFrameWhileTheNextIsNotThere) {
  int ends[2] = {};
  ASSERT_EQ(::pipe(ends), 0);
  const Stream stream = encoded("toy", 5);
  const DecodedStream plain = decode_stream(stream);
  const auto half = static_cast<std::size_t>(plain.index[2].offset);
  std::thread first([&] { EXPECT_EQ(::write(ends[1], stream.data(), half), static_cast<ssize_t>(half)); });
  Player player(std::make_unique<player::PipeInput>("a pipe", ends[0]));
  double now = 50;
  EXPECT_TRUE(eventually([&] {
    now += 0.01;
    const auto frame = player.update(now);
    return frame && frame->number == 4 && player.snapshot().status == Status::kBuffering;
  }));
  first.join();
  EXPECT_EQ(player.update(now + 1)->number, 4u);
  EXPECT_EQ(player.snapshot().frame, 5u);
  std::thread second([&] {
    EXPECT_EQ(::write(ends[1], stream.data() + half, stream.size() - half),
              static_cast<ssize_t>(stream.size() - half));
    ::close(ends[1]);
  });
  EXPECT_TRUE(eventually([&] {
    const auto frame = player.update(now + 2);
    return frame && frame->number == 5 && player.snapshot().status == Status::kReady;
  }));
  second.join();
  EXPECT_EQ(player.snapshot().stalls, 1u);
}

TEST(Player, AFailedStreamKeepsItsFrames) {
  Stream stream = encoded("toy", 5);
  stream.resize(static_cast<std::size_t>(decode_stream(stream).index[2].offset) + 300);
  const TemporaryFile file(stream);
  Player player(player::open_stream_input(file.path()));
  double now = 0;
  EXPECT_TRUE(eventually([&] {
    now += 0.01;
    player.update(now);
    return player.snapshot().status == Status::kFailed && !player.snapshot().playing;
  }));
  EXPECT_NE(player.snapshot().stream.message, "");
  player.seek(2, now);
  EXPECT_TRUE(eventually([&] {
    const auto frame = player.update(now);
    return frame && frame->number == 2;
  }));
}

}  // namespace
}  // namespace tvg::test
