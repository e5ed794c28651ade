#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tvg::cli {

/// When frames are, in seconds, where they do not follow each other at an even rate: what the data "times"
/// say (tvg/properties.hpp). Empty where the bytes are no times that rise.
std::vector<double> times_from(std::span<const std::uint8_t> bytes);

/// Frames on a line of time: those that have a time of their own, and behind them others at an even rate.
class FrameTimeline {
 public:
  /// `times`: that rise, of the first frames; may be empty. `rate`: frames per second of the others.
  FrameTimeline(std::span<const double> times, double rate) : times_(times), rate_(rate) {}

  /// When the frame at this place is, in seconds from the first one on; between frames what lies between.
  double time_at(double frame) const;
  /// The other way round; 0 for a time before the first frame.
  double frame_at(double time) const;

 private:
  std::span<const double> times_;
  double rate_;
};

}  // namespace tvg::cli
