#include "encoder/importers/scene_clip.hpp"

#include "encoder/importers/import_error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

/// A longer clip is taken for a broken one: a day at a thousand samples per second.
constexpr double kMostFrames = 86'400'000;

/// Share of a sample that rounding may put on a clip's duration, which most formats store in float32.
constexpr double kSampleTolerance = 1e-3;

struct TimeRange {
  double first = std::numeric_limits<double>::infinity();
  double last = -std::numeric_limits<double>::infinity();

  bool empty() const { return first > last; }
  void add(const Track& track) {
    first = std::min(first, track.times.front());
    last = std::max(last, track.times.back());
  }
};

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// Whether a key can be used; rotations between which lines are drawn become unit length.
bool make_valid(Track& track, std::size_t key) {
  const std::span<double> values = std::span(track.values).subspan(key * track.key_size(), track.key_size());
  if (!all_finite(values)) return false;
  if (!track.is_rotation) return true;
  const double norm = Eigen::Map<const Eigen::Quaterniond>(track.value(key).data()).norm();
  if (!std::isfinite(norm) || norm < 1e-12) return false;
  if (track.interpolation == Interpolation::kCubic) return true;
  for (double& value : values) value /= norm;
  return true;
}

/// The time within the keys that a repeating channel shows.
double repeated(double seconds, const NodeChannel& channel) {
  if (channel.before != Extrapolation::kRepeat && channel.after != Extrapolation::kRepeat) return seconds;
  TimeRange range;
  for (const Track* track : {&channel.positions, &channel.rotations, &channel.scales}) {
    if (!track->empty()) range.add(*track);
  }
  const bool outside = (seconds < range.first && channel.before == Extrapolation::kRepeat) ||
                       (seconds > range.last && channel.after == Extrapolation::kRepeat);
  if (!outside || !(range.last > range.first)) return seconds;
  const double turns = std::floor((seconds - range.first) / (range.last - range.first));
  return seconds - turns * (range.last - range.first);
}

}  // namespace

Transform Placement::transform() const {
  Transform transform = Transform::Identity();
  transform.translate(position);
  transform.rotate(rotation);
  transform.scale(scale);
  return transform;
}

Transform NodeChannel::at(double seconds) const {
  const double time = repeated(seconds, *this);
  const bool linear_before = before == Extrapolation::kLinear;
  const bool linear_after = after == Extrapolation::kLinear;
  Placement place = rest;
  const auto take = [&](const Track& track, double* out) {
    if (!track.empty()) track.at(time, linear_before, linear_after, {out, track.width});
  };
  take(positions, place.position.data());
  take(rotations, place.rotation.coeffs().data());
  take(scales, place.scale.data());
  return place.transform();
}

void Clip::finish(const std::string& file, const SceneNodes& scene_nodes) {
  const auto fail = [&](const std::string& what) {
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: clip \"{}\" {}", file, name, what));
  };
  TimeRange moving, still;
  const auto take = [&](Track& track, const std::string& whose, const char* what) {
    if (!all_finite(track.times)) fail("has a key at a time that is not finite");
    for (std::size_t key = 0; key < track.times.size(); ++key) {
      if (!make_valid(track, key)) fail(fmt::format("has key {} of {} that is {}", key, whose, what));
    }
    track.sort_by_time();
    // A track with one key stands still, often at a time that a reader made up.
    if (!track.empty()) (track.times.size() > 1 ? moving : still).add(track);
  };
  for (NodeChannel& channel : nodes) {
    const std::string whose = fmt::format("node \"{}\"", scene_nodes.list()[channel.node].name);
    for (Track* track : {&channel.positions, &channel.rotations, &channel.scales}) {
      take(*track, whose, "no finite position, rotation or scale");
    }
  }
  for (MorphChannel& channel : morphs) take(channel.weights, "morph targets", "not finite");
  const TimeRange& range = moving.empty() ? still : moving;
  first = range.empty() ? 0 : range.first;
  last = range.empty() ? 0 : range.last;
}

std::uint64_t Clip::frame_count(double fps) const {
  const double samples = std::ceil(duration() * fps - kSampleTolerance);
  if (samples >= kMostFrames) {
    throw ToolError(
        ExitStatus::kInvalidInput,
        fmt::format("clip \"{}\" lasts {:.6g} s, which is {:.6g} frames at {:.6g} per second: at most "
                    "{:.0f} are read",
                    name, duration(), samples, fps, kMostFrames));
  }
  return static_cast<std::uint64_t>(std::max(samples, 0.0)) + 1;
}

double Clip::time_of(std::uint64_t frame, double fps) const {
  return std::min(first + static_cast<double>(frame) / fps, last);
}

void Clip::pose(double seconds, const std::vector<Transform>& rest, std::vector<Transform>& local) const {
  local = rest;
  for (const NodeChannel& channel : nodes) local[channel.node] = channel.at(seconds);
}

}  // namespace tvg::cli
