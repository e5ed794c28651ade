#include "encoder/importers/skeleton_source.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/scene_skeleton.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

/// The joints of a BVH file over time.
class Motion {
 public:
  explicit Motion(const std::string& path) {
    const std::unique_ptr<SceneReader> reader = read_scene(path);
    const Scene& scene = reader->scene();
    if (scene.clip_names.empty()) scene.fail("it holds no motion");
    std::vector<std::string> notes;
    clip_ = reader->read_clip(0, notes);
    nodes_ = scene.nodes;
    joints_ = find_moved_nodes(nodes_, clip_);
    if (joints_.nodes.empty()) scene.fail("it holds no joints");
    for (const NodeChannel& channel : clip_.nodes) {
      if (channel.rotations.times.size() > times_.size()) times_ = channel.rotations.times;
    }
    rest_ = nodes_.rest_pose();
  }

  const Skeleton& skeleton() const { return joints_.skeleton; }
  /// Times of the file's frames, in seconds.
  const std::vector<double>& times() const { return times_; }

  void pose(double seconds, std::vector<float>& out) {
    clip_.pose(seconds, rest_, local_);
    nodes_.to_scene_space(local_, global_);
    joints_.pose(global_, out);
  }

 private:
  SceneNodes nodes_;
  Clip clip_;
  SceneSkeleton joints_;
  std::vector<double> times_;
  std::vector<Transform> rest_, local_, global_;
};

class SkeletonSource final : public SourceDecorator {
 public:
  /// Without a rate, frames are taken one to one.
  SkeletonSource(std::unique_ptr<FrameSource> source, Motion motion, const SkeletonSpec& spec,
                 std::optional<double> fps)
      : SourceDecorator(std::move(source)),
        file_(spec.file),
        motion_(std::move(motion)),
        fps_(fps),
        first_(spec.first_frame),
        next_(spec.first_frame) {}

  const Skeleton& skeleton() const override { return motion_.skeleton(); }
  std::span<const float> joint_positions() const override { return joint_positions_; }
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override {
    next_ += count;
    return SourceDecorator::skip_frames(count);
  }
  bool rewind() override {
    next_ = first_;
    return SourceDecorator::rewind();
  }

 private:
  std::string file_;
  Motion motion_;
  std::optional<double> fps_;
  std::uint64_t first_;
  std::uint64_t next_;
  std::vector<float> joint_positions_;
};

Result<bool> SkeletonSource::read_frame(std::span<float> positions) {
  Result<bool> read = SourceDecorator::read_frame(positions);
  if (!read || !*read) return read;
  const std::vector<double>& times = motion_.times();
  const double seconds = fps_ ? times.front() + static_cast<double>(next_) / *fps_
                              : times[std::min<std::uint64_t>(next_, times.size() - 1)];
  motion_.pose(seconds, joint_positions_);
  if (find_non_finite(joint_positions_) < joint_positions_.size()) {
    return ImportError(ErrorCode::kInvalidInput,
                       fmt::format("{}: a joint is NaN or infinite at {:.6g} s", file_, seconds))
        .as_value();
  }
  ++next_;
  return true;
}

std::string rate_of(const FrameSource& source, const SkeletonSpec& spec) {
  const Metadata metadata = source.metadata();
  const auto known = metadata.find("fps");
  return !spec.fps.empty() ? spec.fps : known == metadata.end() ? "" : known->second;
}

}  // namespace

std::unique_ptr<FrameSource> attach_skeleton(std::unique_ptr<FrameSource> source, const SkeletonSpec& spec,
                                             std::vector<std::string>& notes) {
  if (!has_suffix(spec.file, ".bvh")) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("--skeleton {}: only BVH files (.bvh) are read", spec.file));
  }
  Motion motion(spec.file);
  const std::size_t frames = motion.times().size();
  std::optional<double> fps;
  if (frames != spec.frame_count) {
    const std::string rate = rate_of(*source, spec);
    const std::string counts =
        fmt::format("{} has {} frames and the input {}", spec.file, frames, spec.frame_count);
    if (rate.empty()) {
      throw ToolError(ExitStatus::kUsage,
                      counts + ": --fps has to say the input's rate, to find them by time");
    }
    fps = parse_rate(rate);
    const double lasts = motion.times().back() - motion.times().front();
    const double needed = static_cast<double>(spec.frame_count - 1) / *fps;
    notes.push_back(fmt::format("{}: joints are found by time at {} frames per second{}", counts, rate,
                                needed > lasts + 0.5 / *fps
                                    ? fmt::format("; after {:.6g} of {:.6g} s they hold still", lasts, needed)
                                    : ""));
  }
  return std::make_unique<SkeletonSource>(std::move(source), std::move(motion), spec, fps);
}

}  // namespace tvg::cli
