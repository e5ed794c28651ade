#pragma once
#include "player/playback/player.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace tvg::player {

/// How playing went: times are in seconds since the command began.
class PlayFigures {
 public:
  /// A frame of the stream that was not shown before has been drawn and presented.
  void add_frame(double now);
  /// A picture was drawn and presented in so many seconds.
  void add_picture(double seconds);

  /// Of the pictures drawn lately.
  double mean_draw_ms() const;
  /// Frames of the stream shown per second, lately.
  double shown_per_second(double now) const;

  /// Everything as JSON, for a program.
  std::string report(const PlayerSnapshot& player, const std::string& location, double now) const;

 private:
  static constexpr std::size_t kRecent = 64;

  std::array<double, kRecent> draw_seconds_{};
  std::array<double, kRecent> frame_times_{};
  std::uint64_t pictures_ = 0;
  std::uint64_t frames_ = 0;
  double first_frame_ = -1;
  double last_frame_ = -1;
  double total_draw_ = 0;
  double longest_draw_ = 0;
  double longest_gap_ = 0;  ///< between two frames shown
};

}  // namespace tvg::player
