#pragma once
#include <cstdint>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// When frames are shown, in seconds: the stream's own times ("times", one float64 for each frame, least
/// significant byte first), else evenly by `fps`.
class OutputTimes {
 public:
  /// Takes "times", and nothing else.
  void add_data(const NamedData& data);
  /// `otherwise`: frames per second where the metadata have no `fps`.
  void set_rate(const Metadata& metadata, double otherwise);

  /// Of a frame of the output, counted from 0. Frames behind the last that has a time follow at the rate.
  double of(std::uint64_t frame) const;
  bool are_uneven() const { return !times_.empty(); }

 private:
  std::vector<double> times_;
  double seconds_per_frame_ = 1;
};

}  // namespace tvg::cli
