#include "encoder/importers/scene_track.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace tvg::cli {

namespace {

using Rotation = Eigen::Map<const Eigen::Quaterniond>;

/// A frame that falls on a key sees it, although most formats keep times of keys in float32.
double step_tolerance(double seconds) {
  return 1e-5 + std::abs(seconds) * 0x1p-22;
}

struct Segment {
  std::size_t key = 0;  // the key before the time; key + 1 exists unless `weight` is 0
  double weight = 0;    // of key + 1
  double duration = 0;  // from key to key + 1
};

Segment find_segment(const std::vector<double>& times, double seconds, bool linear_before,
                     bool linear_after) {
  const std::size_t last = times.size() - 1;
  if (last == 0) return {};
  if (seconds <= times.front() && !linear_before) return {};
  if (seconds >= times.back() && !linear_after) return {last, 0, 0};
  const auto next = std::upper_bound(times.begin(), times.end(), seconds);
  const auto after = std::clamp<std::ptrdiff_t>(next - times.begin(), 1, static_cast<std::ptrdiff_t>(last));
  const auto key = static_cast<std::size_t>(after - 1);
  const double duration = times[key + 1] - times[key];
  return {key, duration > 0 ? (seconds - times[key]) / duration : 0, duration};
}

void copy(std::span<const double> from, std::span<double> to) {
  std::copy(from.begin(), from.end(), to.begin());
}

void hermite(const Track& track, const Segment& segment, std::span<double> out) {
  const double t = segment.weight;
  const double t2 = t * t;
  const double t3 = t2 * t;
  const double* from = &track.values[segment.key * track.key_size()];
  const double* to = from + track.key_size();
  const std::size_t width = track.width;
  for (std::size_t i = 0; i < width; ++i) {
    out[i] = (2 * t3 - 3 * t2 + 1) * from[width + i] +
             segment.duration * (t3 - 2 * t2 + t) * from[2 * width + i] + (3 * t2 - 2 * t3) * to[width + i] +
             segment.duration * (t3 - t2) * to[i];
  }
}

/// Back to unit length; where a spline passes through nothing, the key before.
void normalize_rotation(std::span<const double> key, std::span<double> out) {
  Eigen::Map<Eigen::Quaterniond> rotation(out.data());
  double norm = rotation.norm();
  if (!(norm > 1e-12)) {
    copy(key, out);
    norm = rotation.norm();
  }
  if (norm > 1e-12) {
    rotation.coeffs() /= norm;
  } else {
    rotation.setIdentity();
  }
}

}  // namespace

std::span<const double> Track::value(std::size_t key) const {
  const std::size_t offset = interpolation == Interpolation::kCubic ? width : 0;
  return std::span(values).subspan(key * key_size() + offset, width);
}

void Track::at(double seconds, bool linear_before, bool linear_after, std::span<double> out) const {
  if (interpolation == Interpolation::kStep) {
    const auto next = std::upper_bound(times.begin(), times.end(), seconds + step_tolerance(seconds));
    copy(value(static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - times.begin(), 1) - 1)), out);
    return;
  }
  const Segment segment = find_segment(times, seconds, linear_before, linear_after);
  if (segment.weight == 0) {
    copy(value(segment.key), out);
  } else if (interpolation == Interpolation::kCubic) {
    hermite(*this, segment, out);
  } else if (is_rotation) {
    const Rotation from(value(segment.key).data());
    const Rotation to(value(segment.key + 1).data());
    Eigen::Map<Eigen::Quaterniond>(out.data()) = from.slerp(segment.weight, to);
  } else {
    const std::span<const double> from = value(segment.key);
    const std::span<const double> to = value(segment.key + 1);
    for (std::size_t i = 0; i < width; ++i) out[i] = from[i] + segment.weight * (to[i] - from[i]);
  }
  if (is_rotation && interpolation == Interpolation::kCubic) normalize_rotation(value(segment.key), out);
}

void Track::sort_by_time() {
  if (std::is_sorted(times.begin(), times.end())) return;
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [this](std::size_t a, std::size_t b) { return times[a] < times[b]; });
  Track sorted = *this;
  for (std::size_t key = 0; key < order.size(); ++key) {
    sorted.times[key] = times[order[key]];
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(order[key] * key_size()), key_size(),
                sorted.values.begin() + static_cast<std::ptrdiff_t>(key * key_size()));
  }
  *this = std::move(sorted);
}

}  // namespace tvg::cli
