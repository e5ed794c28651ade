#include "decoder/exporters/frame_times.hpp"

#include "tool/option_values.hpp"

#include <bit>
#include <cmath>

namespace tvg::cli {

namespace {

constexpr std::size_t kTimeBytes = 8;

}  // namespace

void FrameTimes::add_data(const NamedData& data) {
  if (data.name != "times" || data.bytes.size() % kTimeBytes != 0) return;
  std::vector<double> times;
  for (std::size_t at = 0; at < data.bytes.size(); at += kTimeBytes) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < kTimeBytes; ++i) bits |= std::uint64_t{data.bytes[at + i]} << (8 * i);
    times.push_back(std::bit_cast<double>(bits));
    // Times that do not rise are none.
    if (!std::isfinite(times.back()) || (times.size() > 1 && times.back() <= times[times.size() - 2])) return;
  }
  times_ = std::move(times);
}

void FrameTimes::set_rate(const Metadata& metadata, double otherwise) {
  seconds_per_frame_ = 1 / otherwise;
  if (const auto fps = metadata.find("fps"); fps != metadata.end()) {
    if (const auto rate = parse_frame_rate(fps->second)) seconds_per_frame_ = 1 / *rate;
  }
}

double FrameTimes::of(std::uint64_t frame) const {
  if (frame < times_.size()) return times_[frame];
  const double from = times_.empty() ? 0 : times_.back() + seconds_per_frame_;
  return from + static_cast<double>(frame - times_.size()) * seconds_per_frame_;
}

}  // namespace tvg::cli
