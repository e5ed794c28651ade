#include "player/playback/playback_clock.hpp"

#include "tool/option_values.hpp"

#include <gtest/gtest.h>

namespace tvg::player {
namespace {

/// Shows the frame wanted at `now`.
std::uint64_t show(PlaybackClock& clock, double now) {
  const std::uint64_t frame = clock.frame(now);
  clock.shown();
  return frame;
}

TEST(PlaybackClock, FollowsTheRateAndTheSpeed) {
  PlaybackClock clock;
  clock.set_rate(25, 10);
  EXPECT_EQ(clock.frame(12), 0u) << "paused";
  clock.play(12);
  EXPECT_EQ(clock.frame(12.01), 0u);
  EXPECT_EQ(clock.frame(12.05), 1u);
  EXPECT_EQ(clock.frame(14.02), 50u);
  clock.set_speed(0.5, 14.02);
  EXPECT_EQ(clock.frame(16.04), 75u);
  clock.pause(16.04);
  EXPECT_EQ(clock.frame(100), 75u);
  clock.set_speed(100, 100);
  EXPECT_EQ(clock.speed(), PlaybackClock::kFastest);
  clock.set_speed(-1, 100);
  EXPECT_EQ(clock.speed(), PlaybackClock::kSlowest);
}

TEST(PlaybackClock, ShowsUnevenFramesAtTheirOwnTimes) {
  PlaybackClock clock;
  clock.set_rate(10, 0);
  clock.set_times({5, 5.5, 7}, 0);
  clock.play(0);
  EXPECT_EQ(clock.frame(0.4), 0u);
  EXPECT_EQ(clock.frame(0.51), 1u);
  EXPECT_EQ(clock.frame(1.9), 1u);
  EXPECT_EQ(clock.frame(2.01), 2u);
  EXPECT_EQ(clock.frame(2.31), 5u) << "frames behind those follow at the rate";
}

TEST(PlaybackClock, BeginsAgainAfterTheRangeOrStopsAtItsEnd) {
  PlaybackClock clock;
  clock.set_rate(10, 0);
  clock.set_range(20, 29);
  clock.set_looping(true);
  clock.seek(0, 0);
  clock.play(0);
  EXPECT_EQ(clock.frame(0.05), 20u) << "outside the range";
  EXPECT_EQ(clock.frame(0.95), 29u);
  EXPECT_EQ(clock.frame(1.05), 20u);
  EXPECT_EQ(clock.frame(2.55), 25u);
  clock.set_looping(false);
  EXPECT_EQ(clock.frame(9), 29u);
  EXPECT_FALSE(clock.playing());
  clock.play(10);
  EXPECT_EQ(clock.frame(10.15), 21u) << "plays once more";
}

TEST(PlaybackClock, StandsWhileItWaitsAndGoesOnWithoutAJump) {
  PlaybackClock clock;
  clock.set_rate(10, 0);
  clock.play(0);
  for (int f = 0; f < 5; ++f) EXPECT_EQ(show(clock, f * 0.1 + 0.01), static_cast<std::uint64_t>(f));
  EXPECT_EQ(clock.frame(0.51), 5u);
  clock.wait(0.51);
  EXPECT_EQ(clock.frame(30), 5u);
  clock.resume(30);
  EXPECT_EQ(show(clock, 30.05), 5u);
  EXPECT_EQ(show(clock, 30.15), 6u);
  EXPECT_EQ(clock.stalls(), 1u);
  EXPECT_NEAR(clock.waited_seconds(), 29.49, 1e-9);
  EXPECT_EQ(clock.dropped(), 0u);
}

TEST(PlaybackClock, WaitsAfterASeekAndUnnoticedOnesAreNoStalls) {
  PlaybackClock clock;
  clock.set_rate(10, 0);
  clock.play(0);
  show(clock, 0.05);
  clock.seek(50, 0.1);
  clock.wait(0.1);
  clock.shown();
  clock.resume(5);
  EXPECT_EQ(clock.stalls(), 0u);
  show(clock, 5.05);
  clock.wait(5.1);
  clock.resume(5.15);
  EXPECT_EQ(clock.stalls(), 0u);
  EXPECT_EQ(clock.late(), 1u);
  EXPECT_NEAR(clock.waited_seconds(), 0.05, 1e-9);
}

TEST(PlaybackClock, CountsFramesThatWerePassedOver) {
  PlaybackClock clock;
  clock.set_rate(10, 0);
  clock.set_range(0, 9);
  clock.set_looping(true);
  clock.play(0);
  show(clock, 0.01);
  show(clock, 0.41);
  EXPECT_EQ(clock.dropped(), 3u);
  show(clock, 0.81);
  show(clock, 1.11);
  EXPECT_EQ(clock.dropped(), 8u) << "5 to 7, 9 and 0";
  clock.set_speed(4, 1.11);
  show(clock, 1.21);
  EXPECT_EQ(clock.dropped(), 8u) << "at four times the speed a screen cannot show all";
}

TEST(PlaybackClock, StepsPauseAndGoRoundLoops) {
  PlaybackClock clock;
  clock.set_range(0, 9);
  clock.play(0);
  clock.step(1, 0);
  EXPECT_FALSE(clock.playing());
  EXPECT_EQ(clock.frame(1), 1u);
  clock.step(-5, 1);
  EXPECT_EQ(clock.frame(1), 0u);
  clock.set_looping(true);
  clock.step(-1, 1);
  EXPECT_EQ(clock.frame(1), 9u);
  clock.step(1, 1);
  EXPECT_EQ(clock.frame(1), 0u);
}

TEST(PlaybackClock, ReadsFrameRatesOfMetadata) {
  EXPECT_EQ(cli::parse_frame_rate("30"), 30.0);
  EXPECT_EQ(cli::parse_frame_rate("23.976"), 23.976);
  EXPECT_DOUBLE_EQ(*cli::parse_frame_rate("30000/1001"), 30000.0 / 1001);
  for (const char* text :
       {"", "0", "-5", "thirty", "30/0", "30/", "/2", "1e9", "nan", "inf", "30 fps", "30/1/1"}) {
    EXPECT_FALSE(cli::parse_frame_rate(text)) << text;
  }
}

}  // namespace
}  // namespace tvg::player
