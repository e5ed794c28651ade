#include "encoder/importers/scene_clip.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/scene_file.hpp"

#include <algorithm>
#include <assimp/scene.h>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace tvg::cli {

namespace {

/// What assimp's documentation asks readers to assume where a format says nothing.
constexpr double kDefaultTicksPerSecond = 25;

/// A longer clip is taken for a broken one: a day at a thousand samples per second.
constexpr double kMostFrames = 86'400'000;

/// Share of a sample that rounding may put on a clip's duration, which most formats store in float32.
constexpr double kSampleTolerance = 1e-3;

struct Segment {
  std::size_t key = 0;  // the key before the time; key + 1 exists unless `weight` is 0
  double weight = 0;    // of key + 1
};

template <class Value>
Segment find_segment(const Track<Value>& track, double seconds, bool linear_before, bool linear_after) {
  const std::vector<double>& times = track.times;
  const std::size_t last = times.size() - 1;
  if (last == 0) return {};
  if (seconds <= times.front() && !linear_before) return {};
  if (seconds >= times.back() && !linear_after) return {last, 0};
  const auto next = std::upper_bound(times.begin(), times.end(), seconds);
  const auto after = std::clamp<std::ptrdiff_t>(next - times.begin(), 1, static_cast<std::ptrdiff_t>(last));
  const auto key = static_cast<std::size_t>(after - 1);
  const double span = times[key + 1] - times[key];
  return {key, span > 0 ? (seconds - times[key]) / span : 0};
}

Eigen::Vector3d blend(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double weight) {
  return a + weight * (b - a);
}

Eigen::Quaterniond blend(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double weight) {
  return a.slerp(weight, b);
}

template <class Value>
Value sample(const Track<Value>& track, double seconds, const NodeChannel& channel) {
  const Segment segment = find_segment(track, seconds, channel.before == Extrapolation::kLinear,
                                       channel.after == Extrapolation::kLinear);
  if (segment.weight == 0) return track.values[segment.key];
  return blend(track.values[segment.key], track.values[segment.key + 1], segment.weight);
}

/// Keys in order of time, which few formats promise.
template <class Value>
void sort_by_time(Track<Value>& track) {
  if (std::is_sorted(track.times.begin(), track.times.end())) return;
  std::vector<std::size_t> order(track.times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&track](std::size_t a, std::size_t b) { return track.times[a] < track.times[b]; });
  Track<Value> sorted;
  for (const std::size_t key : order) {
    sorted.times.push_back(track.times[key]);
    sorted.values.push_back(std::move(track.values[key]));
  }
  track = std::move(sorted);
}

Eigen::Vector3d to_value(const aiVector3D& value) {
  return {double{value.x}, double{value.y}, double{value.z}};
}

Eigen::Quaterniond to_value(const aiQuaternion& value) {
  return {double{value.w}, double{value.x}, double{value.y}, double{value.z}};
}

bool make_valid(Eigen::Vector3d& value) {
  return value.allFinite();
}

bool make_valid(Eigen::Quaterniond& value) {
  const double norm = value.norm();
  if (!std::isfinite(norm) || norm < 1e-12) return false;
  value.normalize();
  return true;
}

Extrapolation extrapolation(aiAnimBehaviour behaviour) {
  switch (behaviour) {
    case aiAnimBehaviour_LINEAR:
      return Extrapolation::kLinear;
    case aiAnimBehaviour_REPEAT:
      return Extrapolation::kRepeat;
    default:
      return Extrapolation::kHold;
  }
}

struct TimeRange {
  double first = std::numeric_limits<double>::infinity();
  double last = -std::numeric_limits<double>::infinity();

  bool empty() const { return first > last; }
};

class ClipReader {
 public:
  ClipReader(const SceneFile& file, const SceneNodes& nodes, const aiAnimation& animation)
      : file_(file), nodes_(nodes), animation_(animation) {
    const double rate = animation.mTicksPerSecond;
    ticks_per_second_ = std::isfinite(rate) && rate > 0 ? rate : kDefaultTicksPerSecond;
    clip_.name = animation.mName.C_Str();
  }

  Clip read() {
    for (unsigned i = 0; i < animation_.mNumChannels; ++i) {
      if (animation_.mChannels[i] != nullptr) read_node_channel(*animation_.mChannels[i]);
    }
    for (unsigned i = 0; i < animation_.mNumMorphMeshChannels; ++i) {
      if (animation_.mMorphMeshChannels[i] != nullptr) read_morph_channel(*animation_.mMorphMeshChannels[i]);
    }
    const TimeRange& range = moving_.empty() ? still_ : moving_;
    clip_.first = range.empty() ? 0 : range.first;
    clip_.last = range.empty() ? 0 : range.last;
    return std::move(clip_);
  }

 private:
  double to_seconds(double ticks) {
    const double seconds = ticks / ticks_per_second_;
    if (!std::isfinite(seconds)) fail("has a key at a time that is not finite");
    return seconds;
  }

  template <class Value, class Key>
  void read_track(const Key* keys, unsigned count, const std::string& node, Track<Value>& track) {
    for (unsigned i = 0; keys != nullptr && i < count; ++i) {
      track.times.push_back(to_seconds(keys[i].mTime));
      track.values.push_back(to_value(keys[i].mValue));
      if (!make_valid(track.values.back())) {
        fail(fmt::format("has key {} of node \"{}\" that is no finite position, rotation or scale", i, node));
      }
    }
    sort_by_time(track);
    add_to_range(track.times);
  }

  /// A track with one key stands still, often at a time that assimp made up.
  void add_to_range(const std::vector<double>& times) {
    if (times.empty()) return;
    TimeRange& range = times.size() > 1 ? moving_ : still_;
    range.first = std::min(range.first, times.front());
    range.last = std::max(range.last, times.back());
  }

  void read_node_channel(const aiNodeAnim& source) {
    const std::string name = source.mNodeName.C_Str();
    const std::int32_t node = nodes_.find(name);
    // Files name cameras, lights or IK targets that were not exported.
    if (node < 0) return;
    NodeChannel channel;
    channel.node = static_cast<std::size_t>(node);
    read_track(source.mPositionKeys, source.mNumPositionKeys, name, channel.positions);
    read_track(source.mRotationKeys, source.mNumRotationKeys, name, channel.rotations);
    read_track(source.mScalingKeys, source.mNumScalingKeys, name, channel.scales);
    channel.before = extrapolation(source.mPreState);
    channel.after = extrapolation(source.mPostState);
    keep_rest_where_empty(nodes_.list()[channel.node].source->mTransformation, channel);
    clip_.nodes.push_back(std::move(channel));
  }

  void keep_rest_where_empty(const aiMatrix4x4& matrix, NodeChannel& channel) {
    aiVector3D position;
    aiVector3D scale;
    aiQuaternion rotation;
    matrix.Decompose(scale, rotation, position);
    if (channel.positions.times.empty()) channel.positions = {{0.0}, {to_value(position)}};
    if (channel.scales.times.empty()) channel.scales = {{0.0}, {to_value(scale)}};
    if (channel.rotations.times.empty()) {
      Eigen::Quaterniond value = to_value(rotation);
      channel.rotations = {{0.0}, {make_valid(value) ? value : Eigen::Quaterniond::Identity()}};
    }
  }

  void read_morph_channel(const aiMeshMorphAnim& source) {
    MorphChannel channel;
    channel.target = source.mName.C_Str();
    for (unsigned i = 0; source.mKeys != nullptr && i < source.mNumKeys; ++i) {
      const aiMeshMorphKey& key = source.mKeys[i];
      std::vector<double> weights;
      for (unsigned entry = 0; entry < key.mNumValuesAndWeights; ++entry) {
        const unsigned target = key.mValues[entry];
        if (target > kMostMorphTargets || !std::isfinite(key.mWeights[entry])) {
          fail(
              fmt::format("has key {} of the morph targets of \"{}\" that is not finite", i, channel.target));
        }
        if (target >= weights.size()) weights.resize(target + std::size_t{1});
        weights[target] = key.mWeights[entry];
      }
      channel.target_count = std::max(channel.target_count, weights.size());
      channel.weights.times.push_back(to_seconds(key.mTime));
      channel.weights.values.push_back(std::move(weights));
    }
    if (channel.weights.times.empty()) return;
    for (std::vector<double>& weights : channel.weights.values) weights.resize(channel.target_count);
    sort_by_time(channel.weights);
    add_to_range(channel.weights.times);
    clip_.morphs.push_back(std::move(channel));
  }

  [[noreturn]] void fail(const std::string& what) const {
    file_.fail(fmt::format("clip \"{}\" {}", clip_.name, what));
  }

  static constexpr unsigned kMostMorphTargets = 1u << 16;

  const SceneFile& file_;
  const SceneNodes& nodes_;
  const aiAnimation& animation_;
  double ticks_per_second_ = kDefaultTicksPerSecond;
  Clip clip_;
  TimeRange moving_, still_;
};

/// The time within the keys that a repeating channel shows.
double repeated(double seconds, const NodeChannel& channel) {
  const double first = std::min(
      {channel.positions.times.front(), channel.rotations.times.front(), channel.scales.times.front()});
  const double last =
      std::max({channel.positions.times.back(), channel.rotations.times.back(), channel.scales.times.back()});
  const bool outside = (seconds < first && channel.before == Extrapolation::kRepeat) ||
                       (seconds > last && channel.after == Extrapolation::kRepeat);
  if (!outside || !(last > first)) return seconds;
  const double turns = std::floor((seconds - first) / (last - first));
  return seconds - turns * (last - first);
}

}  // namespace

Transform NodeChannel::at(double seconds) const {
  const double time = repeated(seconds, *this);
  Transform transform = Transform::Identity();
  transform.translate(sample(positions, time, *this));
  transform.rotate(sample(rotations, time, *this));
  transform.scale(sample(scales, time, *this));
  return transform;
}

void MorphChannel::at(double seconds, std::vector<double>& weights_out) const {
  const Segment segment = find_segment(weights, seconds, false, false);
  weights_out = weights.values[segment.key];
  if (segment.weight == 0) return;
  const std::vector<double>& next = weights.values[segment.key + 1];
  for (std::size_t i = 0; i < target_count; ++i) {
    weights_out[i] += segment.weight * (next[i] - weights_out[i]);
  }
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

void Clip::pose(double seconds, const std::vector<Transform>& rest, std::vector<Transform>& local) const {
  local = rest;
  for (const NodeChannel& channel : nodes) local[channel.node] = channel.at(seconds);
}

Clip read_clip(const SceneFile& file, const SceneNodes& nodes, std::size_t index) {
  return ClipReader(file, nodes, *file.scene().mAnimations[index]).read();
}

std::size_t find_clip(const SceneFile& file, const std::string& wanted) {
  const aiScene& scene = file.scene();
  std::string names;
  for (unsigned i = 0; i < scene.mNumAnimations; ++i) {
    const std::string name = scene.mAnimations[i]->mName.C_Str();
    if (name == wanted) return i;
    names += fmt::format("{}{} \"{}\"", i == 0 ? "" : ", ", i, name);
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (error == std::errc() && end == wanted.data() + wanted.size() && number < scene.mNumAnimations)
    return number;
  throw ToolError(ExitStatus::kUsage,
                  fmt::format("--clip {}: {} has no clip of that name or number; {}", wanted, file.path(),
                              names.empty() ? "it has no clips at all" : "it has " + names));
}

}  // namespace tvg::cli
