#include "player/frames/shown_frames.hpp"
#include "tool/frame_times.hpp"
#include "tool/option_values.hpp"
#include "tool/tool_error.hpp"

#include <tvg/encoder.hpp>

namespace tvg::player {

namespace {

/// Frames of mesh files and caches. They have no GOPs: those that encoding them by default would make stand
/// in.
class SourceFrames final : public ShownFrames {
 public:
  explicit SourceFrames(const ShownFramesSpec& spec) {
    const bool cut = spec.frames && !spec.whole_gops;
    source_ = spec.open_source(spec.inputs, cut ? spec.frames : std::nullopt);
    has_surfaces_ = spec.surfaces;
    if (has_surfaces_) {
      for (const NamedData& data : source_->data()) materials_.take(data);
      materials_.make(folder_of(spec.inputs));
    }
    take_mesh();
    if (cut) begin_ = spec.frames->first;
    number_ = begin_;
    if (!spec.frames || cut) return;
    if (source_->frame_count())
      cli::check_frame_range(*spec.frames, *source_->frame_count(), spec.inputs.back());
    first_ = spec.frames->first - spec.frames->first % kGopFrames;
    last_ = spec.frames->last - spec.frames->last % kGopFrames + kGopFrames - 1;
  }

  bool next(ShownFrame& frame) override {
    do {
      if (number_ > last_ || !read(frame.positions)) return false;
    } while (number_++ < first_);
    frame.mesh = mesh_;
    frame.surface = surface_;
    frame.number = number_ - 1;
    frame.gop = frame.number / kGopFrames;
    frame.flags.reset();
    const std::span<const float> joints = source_->joint_positions();
    frame.joints.assign(joints.begin(), joints.end());
    frame.values.clear();
    frame.colours.clear();
    if (surface_ == nullptr || !surface_->frame_colours) return true;
    const std::span<const float> colours = source_->animated_values(surface_->frame_colours->attribute);
    frame.colours.assign(colours.begin(), colours.end());
    return true;
  }

  bool rewind() override {
    if (!source_->rewind()) return false;
    number_ = begin_;
    if (source_->mesh_may_change()) take_mesh();
    return true;
  }

  std::optional<std::uint64_t> total() const override {
    const std::optional<std::uint64_t> frames = source_->frame_count();
    return frames ? std::optional(begin_ + *frames) : std::nullopt;
  }
  const Skeleton& skeleton() const override { return source_->skeleton(); }
  Metadata metadata() const override { return source_->metadata(); }
  std::vector<double> times() const override {
    std::vector<double> times;
    for (const NamedData& data : source_->data()) {
      if (data.name == "times") times = cli::times_from(data.bytes);
    }
    // A source that was cut has the times of what is left of it; what is before them is not shown.
    for (std::uint64_t i = 0; i < begin_ && !times.empty(); ++i)
      times.insert(times.begin(), times.front() - 1);
    return times;
  }
  std::string note() const override { return materials_.note(); }

 private:
  void take_mesh() {
    mesh_ = std::make_shared<const Mesh>(source_->mesh());
    if (has_surfaces_) surface_ = make_surface(*mesh_, source_->properties(), materials_);
  }

  /// Reads a frame, of the next mesh where that begins here. False at the end.
  bool read(FramePositions& positions) {
    for (;;) {
      const Result<SourceStep> step = read_step(*source_, positions);
      if (!step) throw cli::tool_error(step.error());
      if (*step != SourceStep::kMesh) return *step == SourceStep::kFrame;
      take_mesh();
    }
  }

  inline static const std::uint64_t kGopFrames = EncodeOptions{}.gop_frames;

  std::unique_ptr<FrameSource> source_;
  std::shared_ptr<const Mesh> mesh_;
  bool has_surfaces_ = false;
  ShownMaterials materials_;
  std::shared_ptr<const Surface> surface_;
  std::uint64_t begin_ = 0;   // number of the source's first frame
  std::uint64_t number_ = 0;  // of the source's next frame
  std::uint64_t first_ = 0;   // frames before it are passed over
  std::uint64_t last_ = UINT64_MAX;
};

}  // namespace

std::unique_ptr<ShownFrames> open_source_frames(const ShownFramesSpec& spec) {
  return std::make_unique<SourceFrames>(spec);
}

}  // namespace tvg::player
