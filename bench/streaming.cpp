#include "player/playback/player.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

// tvg_streaming: how soon a stream shows its first frame, how soon a seek shows its frame, and whether it
// plays without stalls. A screen is simulated by asking for a picture 60 times a second.
namespace tvg::bench {

namespace {

using Clock = std::chrono::steady_clock;

double now() {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

void wait_for_next_picture() {
  std::this_thread::sleep_for(std::chrono::microseconds(16667));
}

/// Asks for pictures until `number` (any frame where absent) is shown; the seconds it took. Asks more often
/// than a screen, so as to measure the player and not the screen.
double seconds_until_shown(player::Player& player, std::optional<std::uint64_t> number) {
  constexpr double kGiveUp = 60;
  const double start = now();
  for (;;) {
    const std::shared_ptr<const player::PlayerFrame> frame = player.update(now());
    if (frame && (!number || frame->number == *number)) return now() - start;
    const bool failed = player.snapshot().status == player::PlayerSnapshot::Status::kFailed;
    if (failed || now() - start > kGiveUp) {
      throw cli::ToolError(cli::ExitStatus::kOther,
                           failed ? player.snapshot().stream.message : "no frame came for 60 s");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void measure_seeks(const std::string& location, int count) {
  double start = now();
  player::PlayerOptions options;
  options.playing = false;
  player::Player player(player::open_stream_input(location), options);
  seconds_until_shown(player, std::nullopt);
  fmt::print("first frame             {:8.3f} s\n", now() - start);
  while (!player.snapshot().stream.frame_count && now() - start < 60) wait_for_next_picture();
  const std::optional<std::uint64_t> frames = player.snapshot().stream.frame_count;
  if (!frames || count < 1) return;
  std::mt19937 random(1);
  std::vector<double> times;
  int on_hand = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t frame = std::uniform_int_distribution<std::uint64_t>(0, *frames - 1)(random);
    const std::vector<player::FrameRun> buffered = player.snapshot().stream.buffered;
    on_hand += std::any_of(buffered.begin(), buffered.end(), [frame](const player::FrameRun& run) {
      return frame >= run.first && frame < run.first + run.count;
    });
    player.seek(frame, now());
    times.push_back(seconds_until_shown(player, frame));
  }
  std::sort(times.begin(), times.end());
  fmt::print(
      "{:3} seeks: median       {:8.3f} s\n           longest      {:8.3f} s   ({} had their bytes on "
      "hand)\n",
      count, times[times.size() / 2], times.back(), on_hand);
}

void measure_playback(const std::string& location, double seconds) {
  player::Player player(player::open_stream_input(location));
  seconds_until_shown(player, std::nullopt);
  const double start = now();
  std::uint64_t pictures = 0;
  while (now() - start < seconds) {
    player.update(now());
    ++pictures;
    wait_for_next_picture();
  }
  const player::PlayerSnapshot snapshot = player.snapshot();
  fmt::print(
      "played {:.1f} s at {:.3g} fps, {} pictures: {} stalls, {} frames late (waited {:.2f} s), {} dropped\n",
      now() - start, snapshot.rate, pictures, snapshot.stalls, snapshot.late, snapshot.waited_seconds,
      snapshot.dropped);
  fmt::print("decoding                {:8.2f} ms a frame, {:.2f} ms at most; {} frame slots\n",
             snapshot.stream.mean_decode_ms, snapshot.stream.max_decode_ms, snapshot.stream.frame_slots);
  const std::uint64_t bytes = snapshot.stream.stream_bytes.value_or(0);
  const double length = static_cast<double>(snapshot.stream.known_frames) / snapshot.rate;
  fmt::print("stream                  {:8.2f} MB, {:.2f} Mbit/s on average; {:.2f} MB received\n",
             static_cast<double>(bytes) / 1e6, length > 0 ? 8e-6 * static_cast<double>(bytes) / length : 0,
             static_cast<double>(snapshot.stream.input.bytes_received) / 1e6);
}

int run(int argc, char** argv) {
  CLI::App app("Time to the first frame, seek times and stalls of a stream");
  std::string location;
  int seeks = 20;
  double seconds = 20;
  app.add_option("stream", location, "a file or a URL")->required();
  app.add_option("--seeks", seeks, "seeks to random frames (default 20)");
  app.add_option("--seconds", seconds, "of playback (default 20)");
  CLI11_PARSE(app, argc, argv);
  try {
    measure_seeks(location, seeks);
    if (seconds > 0) measure_playback(location, seconds);
  } catch (const cli::ToolError& error) {
    fmt::print(stderr, "tvg_streaming: {}\n", error.what());
    return static_cast<int>(error.status());
  }
  return 0;
}

}  // namespace

}  // namespace tvg::bench

int main(int argc, char** argv) {
  return tvg::bench::run(argc, argv);
}
