#include "encoder/importers/frame_times.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace tvg::cli {

std::size_t FrameTimes::first_uneven() const {
  if (times_.size() < 2) return times_.size();
  const double first = times_[0];
  const double step = double{times_[1]} - first;
  for (std::size_t frame = 0; frame < times_.size(); ++frame) {
    const double expected = first + static_cast<double>(frame) * step;
    // A thousandth of a step, and what float32 rounds away.
    const double tolerance = 1e-3 * std::abs(step) + 1e-6 * std::abs(expected);
    if (!(std::abs(double{times_[frame]} - expected) <= tolerance)) return frame;
  }
  return times_.size();
}

bool FrameTimes::rise() const {
  for (std::size_t frame = 0; frame < times_.size(); ++frame) {
    if (!std::isfinite(times_[frame]) || (frame > 0 && times_[frame] <= times_[frame - 1])) return false;
  }
  return true;
}

std::string FrameTimes::rate() const {
  if (times_.size() < 2 || first_uneven() < times_.size()) return "";
  const double rate = static_cast<double>(times_.size() - 1) / (double{times_.back()} - double{times_[0]});
  if (!(rate > 1.001 && rate < 1000)) return "";
  const double whole = std::round(rate);
  if (std::abs(rate - whole) < 1e-4 * rate) return fmt::format("{:.0f}", whole);
  const double ntsc = std::round(rate * 1.001);
  if (std::abs(rate - ntsc / 1.001) < 1e-4 * rate) return fmt::format("{:.0f}/1001", 1000 * ntsc);
  return fmt::format("{:.0f}/1000", std::round(1000 * rate));
}

bool FrameTimes::counts_frames() const {
  return times_.size() > 1 && first_uneven() == times_.size() && rate().empty();
}

std::string FrameTimes::start(double given_rate) const {
  if (times_.empty() || times_[0] == 0 || !std::isfinite(times_[0])) return "";
  if (!counts_frames()) return fmt::format("{}", times_[0]);
  return given_rate > 0 ? fmt::format("{:.9g}", double{times_[0]} / given_rate) : "";
}

std::string FrameTimes::span() const {
  return times_.empty() ? "" : fmt::format("{:.6g} to {:.6g}", times_[0], times_.back());
}

NamedData FrameTimes::data() const {
  NamedData data{kTimesData, {}};
  data.bytes.reserve(times_.size() * sizeof(double));
  for (const float time : times_) {
    const auto bits = std::bit_cast<std::uint64_t>(double{time});
    for (int byte = 0; byte < 8; ++byte) data.bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * byte)));
  }
  return data;
}

NamedData cut_times(const NamedData& times, std::uint64_t first, std::uint64_t count) {
  const std::uint64_t held = times.bytes.size() / sizeof(double);
  const std::uint64_t begin = std::min(first, held);
  const std::uint64_t end = begin + std::min(count, held - begin);
  return {times.name,
          {times.bytes.begin() + static_cast<std::ptrdiff_t>(begin * sizeof(double)),
           times.bytes.begin() + static_cast<std::ptrdiff_t>(end * sizeof(double))}};
}

}  // namespace tvg::cli
