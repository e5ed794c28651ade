#include "decoder/exporters/output_times.hpp"

#include "tool/frame_times.hpp"
#include "tool/option_values.hpp"

namespace tvg::cli {

void OutputTimes::add_data(const NamedData& data) {
  if (data.name == "times") times_ = times_from(data.bytes);
}

void OutputTimes::set_rate(const Metadata& metadata, double otherwise) {
  seconds_per_frame_ = 1 / otherwise;
  if (const auto fps = metadata.find("fps"); fps != metadata.end()) {
    if (const auto rate = parse_frame_rate(fps->second)) seconds_per_frame_ = 1 / *rate;
  }
}

double OutputTimes::of(std::uint64_t frame) const {
  if (frame < times_.size()) return times_[frame];
  const double from = times_.empty() ? 0 : times_.back() + seconds_per_frame_;
  return from + static_cast<double>(frame - times_.size()) * seconds_per_frame_;
}

}  // namespace tvg::cli
