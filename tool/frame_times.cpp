#include "tool/frame_times.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tvg::cli {

std::vector<double> times_from(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kTimeBytes = 8;
  std::vector<double> times;
  if (bytes.size() % kTimeBytes != 0) return times;
  for (std::size_t at = 0; at < bytes.size(); at += kTimeBytes) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < kTimeBytes; ++i) bits |= std::uint64_t{bytes[at + i]} << (8 * i);
    const auto time = std::bit_cast<double>(bits);
    if (!std::isfinite(time) || (!times.empty() && time <= times.back())) return {};
    times.push_back(time);
  }
  return times;
}

double FrameTimeline::time_at(double frame) const {
  if (times_.empty()) return frame / rate_;
  const auto last = static_cast<double>(times_.size() - 1);
  if (frame >= last) return times_.back() - times_.front() + (frame - last) / rate_;
  const auto before = static_cast<std::size_t>(std::max(0.0, frame));
  const double share = std::max(0.0, frame) - static_cast<double>(before);
  return times_[before] - times_.front() + share * (times_[before + 1] - times_[before]);
}

double FrameTimeline::frame_at(double time) const {
  if (times_.empty()) return time * rate_;
  const double wanted = times_.front() + std::max(0.0, time);
  const auto last = static_cast<double>(times_.size() - 1);
  if (wanted >= times_.back()) return last + (wanted - times_.back()) * rate_;
  const auto after = std::upper_bound(times_.begin(), times_.end(), wanted);
  const auto before = static_cast<std::size_t>(after - times_.begin()) - 1;
  return static_cast<double>(before) + (wanted - times_[before]) / (times_[before + 1] - times_[before]);
}

}  // namespace tvg::cli
