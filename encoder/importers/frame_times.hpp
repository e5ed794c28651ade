#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::cli {

/// The name of the data that have the time of each frame (tvg/properties.hpp).
inline constexpr const char* kTimesData = "times";

/// The times of a cache's frames.
class FrameTimes {
 public:
  void add(float time) { times_.push_back(time); }

  /// The first frame that does not stand where even steps lead; the number of frames where all do.
  std::size_t first_uneven() const;
  /// Whether each is a number, and later than the one before.
  bool rise() const;
  /// "30", "30000/1001" or the like; empty where the times are uneven or count frames instead of seconds.
  std::string rate() const;
  /// When the first frame is, in seconds: "0.5". Empty where that is 0, or where the times count frames and
  /// `given_rate` (a frame rate, or 0) does not say how long one is.
  std::string start(double given_rate) const;
  /// From the first to the last, for messages: "0.5 to 2".
  std::string span() const;
  /// The data "times".
  NamedData data() const;

 private:
  bool counts_frames() const;

  std::vector<float> times_;
};

/// The data "times" without all but `count` frames from `first` on.
NamedData cut_times(const NamedData& times, std::uint64_t first, std::uint64_t count);

}  // namespace tvg::cli
