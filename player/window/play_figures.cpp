#include "player/window/play_figures.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

namespace tvg::player {

void PlayFigures::add_frame(double now) {
  if (frames_ == 0) {
    first_frame_ = now;
  } else {
    longest_gap_ = std::max(longest_gap_, now - last_frame_);
  }
  last_frame_ = now;
  frame_times_[frames_++ % kRecent] = now;
}

void PlayFigures::add_picture(double seconds) {
  draw_seconds_[pictures_++ % kRecent] = seconds;
  total_draw_ += seconds;
  longest_draw_ = std::max(longest_draw_, seconds);
}

double PlayFigures::mean_draw_ms() const {
  const std::size_t count = std::min<std::uint64_t>(pictures_, kRecent);
  if (count == 0) return 0;
  return 1000 *
         std::accumulate(draw_seconds_.begin(), draw_seconds_.begin() + static_cast<std::ptrdiff_t>(count),
                         0.0) /
         static_cast<double>(count);
}

double PlayFigures::shown_per_second(double now) const {
  const std::size_t count = std::min<std::uint64_t>(frames_, kRecent);
  const auto lately =
      std::count_if(frame_times_.begin(), frame_times_.begin() + static_cast<std::ptrdiff_t>(count),
                    [now](double time) { return time > now - 1; });
  return static_cast<double>(lately);
}

std::string PlayFigures::report(const PlayerSnapshot& player, const std::string& location, double now) const {
  const double playing = last_frame_ - first_frame_;
  const nlohmann::ordered_json report = {
      {"stream", location},
      {"first_frame_seconds", frames_ > 0 ? nlohmann::ordered_json(first_frame_) : nlohmann::ordered_json()},
      {"seconds", now},
      {"frames_shown", frames_},
      {"frames_per_second", playing > 0 ? static_cast<double>(frames_ - 1) / playing : 0},
      {"longest_gap_ms", 1000 * longest_gap_},
      {"dropped", player.dropped},
      {"stalls", player.stalls},
      {"late", player.late},
      {"waited_seconds", player.waited_seconds},
      {"draw_ms_mean", pictures_ > 0 ? 1000 * total_draw_ / static_cast<double>(pictures_) : 0},
      {"draw_ms_max", 1000 * longest_draw_},
      {"decode_ms_mean", player.stream.mean_decode_ms},
      {"decode_ms_max", player.stream.max_decode_ms},
      {"frames_decoded", player.stream.frames_decoded},
      {"frame_slots", player.stream.frame_slots},
      {"ring_capacity", player.stream.ring_capacity},
      {"bytes_received", player.stream.input.bytes_received},
      {"bytes_read", player.stream.bytes_read},
      {"lod", player.stream.lod},
      {"damaged_places", player.stream.damage.size()},
      {"message", player.stream.message},
  };
  return report.dump(2) + "\n";
}

}  // namespace tvg::player
