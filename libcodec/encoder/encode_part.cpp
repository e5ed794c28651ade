#include "base/errors.hpp"
#include "container/frame_data.hpp"
#include "encoder/encode_checks.hpp"
#include "encoder/sequence_encoder.hpp"
#include "encoder/settled_options.hpp"
#include "source/look_through.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <new>
#include <string>
#include <utility>

#include <tvg/parts.hpp>

namespace tvg {

namespace {

std::string range_text(const FrameRange& frames) {
  return std::to_string(frames.first) + "-" + std::to_string(frames.last);
}

/// What Encoder would find: a mesh that comes again is not shaped anew as long as a decoder knows it.
void tell_what_shaped(std::vector<SourceStretch>& stretches, std::uint32_t meshes) {
  std::deque<const SourceStretch*> in_force;
  for (SourceStretch& stretch : stretches) {
    const auto known = std::find_if(in_force.begin(), in_force.end(), [&](const SourceStretch* other) {
      return other->mesh_hash == stretch.mesh_hash;
    });
    if (known != in_force.end()) {
      stretch.shaped_by = (*known)->shaped_by;
      continue;
    }
    stretch.shaped_by = stretch.first_frame;
    in_force.push_back(&stretch);
    if (in_force.size() > meshes) in_force.pop_front();
  }
}

/// The frames of a source, by their numbers in ascending order.
class FrameWalk {
 public:
  explicit FrameWalk(FrameSource& source) : source_(source) {}

  /// Reads a frame, at or behind the one that comes next; its mesh is then the source's.
  Status read(std::uint64_t frame) {
    if (frame > next_) {
      if (Status status = source_.skip_frames(frame - next_); !status.ok()) return status;
      next_ = frame;
    }
    for (;;) {
      const Result<SourceStep> step = read_step(source_, positions_);
      if (!step) return step.error();
      if (*step == SourceStep::kEnd)
        return at_frame(frame, invalid_input("the input ends here; it was longer when it was planned"));
      if (*step == SourceStep::kMesh) continue;
      ++next_;
      return {};
    }
  }
  /// The same, but looks at all frames on the way: what a source makes of a mesh may depend on those before.
  Status read_all_to(std::uint64_t frame) {
    if (!source_.rewind()) return Error{ErrorCode::kIo, "the input cannot be read a second time"};
    for (next_ = 0; next_ <= frame;) {
      if (Status status = read(next_); !status.ok()) return status;
    }
    return {};
  }

  FrameSource& source() { return source_; }
  const FramePositions& positions() const { return positions_; }

 private:
  FrameSource& source_;
  std::uint64_t next_ = 0;
  FramePositions positions_;
};

const SourceStretch& stretch_of(const EncodePlan& plan, std::uint64_t frame) {
  const auto after = std::upper_bound(
      plan.stretches.begin(), plan.stretches.end(), frame,
      [](std::uint64_t number, const SourceStretch& other) { return number < other.first_frame; });
  return *(after - 1);
}

class PartEncoding {
 public:
  PartEncoding(FrameSource& source, const EncodePlan& plan, const FrameRange& part)
      : walk_(source), plan_(plan), part_(part) {}

  Result<EncodeReport> run(const SettledOptions& settled, const ByteSink& sink,
                           const EncodeProgress& progress) {
    const EncodeOptions& options = settled.options;
    if (Status status = read_past(options); !status.ok()) return status.error();
    EncodeProgress with_total;
    if (progress) {
      with_total = [&progress, total = part_.last - part_.first + 1](
                       std::uint64_t frames, std::optional<std::uint64_t>) { progress(frames, total); };
    }
    const bool with_shapes = needs_shape(options), with_joints = uses_skeleton(options.importance);
    SequenceEncoder encoder(options, sink, std::move(with_total));
    for (std::uint64_t frame = part_.first; frame <= part_.last; ++frame) {
      if (Status status = walk_.read(frame); !status.ok()) return status.error();
      FrameSource& source = walk_.source();
      const bool begins = frame == part_.first || frame == stretch_->first_frame + stretch_->frames;
      if (begins) {
        if (Status status = begin_stretch(frame); !status.ok()) return status.error();
        MeshPast past{stretch_->shaped_by, {}, stretch_->first_frame, frame - stretch_->first_frame, {}};
        if (with_shapes && past.shaped_by != frame) past.shape = shapes_.at(past.shaped_by);
        if (past.frames_before > 0) past.gop_before = std::move(gop_before_);
        // Shapes of the part may be wanted again.
        if (with_shapes && past.shaped_by == frame) shapes_.emplace(frame, walk_.positions());
        Status status = encoder.set_mesh(source.mesh(), source.skeleton(), source.properties(), past);
        if (!status.ok()) return status.error();
      }
      Status status = encoder.add_frame(walk_.positions(),
                                        with_joints ? source.joint_positions() : std::span<const float>(),
                                        all_animated_values(source));
      if (!status.ok()) return status.error();
    }
    Result<EncodeReport> report = encoder.finish();
    if (report) report->captured = settled.captured;
    return report;
  }

 private:
  /// Reads of the frames before the part what something in it is made of.
  Status read_past(const EncodeOptions& options) {
    std::map<std::uint64_t, bool> wanted;  // frame, and whether it shapes a mesh
    if (needs_shape(options)) {
      for (const SourceStretch& stretch : plan_.stretches) {
        const bool is_of_part =
            stretch.first_frame <= part_.last && stretch.first_frame + stretch.frames > part_.first;
        if (is_of_part && stretch.shaped_by < part_.first) wanted[stretch.shaped_by] = true;
      }
    }
    const SourceStretch& first = stretch_of(plan_, part_.first);
    if (options.importance.low_delay && part_.first > first.first_frame) {
      gop_before_ = std::make_shared<GopFrames>();
      for (std::uint64_t frame = part_.first - plan_.frames_at_once; frame < part_.first; ++frame)
        wanted.emplace(frame, false);
    }
    for (const auto& [frame, shapes] : wanted) {
      if (Status status = walk_.read(frame); !status.ok()) return status;
      if (Status status = check_mesh_of(stretch_of(plan_, frame), frame); !status.ok()) return status;
      if (shapes) shapes_.emplace(frame, walk_.positions());
      if (gop_before_ && frame + plan_.frames_at_once >= part_.first) keep_before(options);
    }
    return {};
  }

  void keep_before(const EncodeOptions& options) {
    gop_before_->frames.push_back(walk_.positions());
    if (!uses_skeleton(options.importance)) return;
    const std::span<const float> joints = walk_.source().joint_positions();
    gop_before_->joints.emplace_back(joints.begin(), joints.end());
  }

  Status begin_stretch(std::uint64_t frame) {
    stretch_ = &stretch_of(plan_, frame);
    return check_mesh_of(*stretch_, frame);
  }

  /// The frame that was read last shall have the mesh of this stretch.
  Status check_mesh_of(const SourceStretch& stretch, std::uint64_t frame) {
    if (mesh_hash(walk_.source()) == stretch.mesh_hash) return {};
    if (Status status = walk_.read_all_to(frame); !status.ok()) return status;
    if (mesh_hash(walk_.source()) == stretch.mesh_hash) return {};
    return at_frame(frame, invalid_input("the mesh is another one than when the input was planned"));
  }

  FrameWalk walk_;
  const EncodePlan& plan_;
  const FrameRange part_;
  const SourceStretch* stretch_ = nullptr;
  std::map<std::uint64_t, FramePositions> shapes_;  ///< of meshes, by the frames that shaped them
  std::shared_ptr<GopFrames> gop_before_;
};

/// A plan may have been on its way through a file.
Status check_plan(const EncodePlan& plan) {
  std::uint64_t frames = 0;
  bool holds = plan.frames_at_once > 0 && !plan.stretches.empty() && (!plan.box || !plan.box->empty());
  for (const SourceStretch& stretch : plan.stretches) {
    holds = holds && stretch.first_frame == frames && stretch.frames > 0 &&
            stretch.frames <= plan.frames - frames && stretch.shaped_by <= stretch.first_frame;
    if (!holds) break;
    frames += stretch.frames;
  }
  return holds && frames == plan.frames ? Status() : invalid_argument("the plan contradicts itself");
}

/// Whether a part may begin with this frame, or end before it.
bool is_border(const EncodePlan& plan, std::uint64_t frame) {
  if (frame == plan.frames) return true;
  return (frame - stretch_of(plan, frame).first_frame) % plan.frames_at_once == 0;
}

Status check_part(const EncodePlan& plan, const FrameRange& part) {
  if (part.first > part.last || part.last >= plan.frames)
    return invalid_argument("frames " + range_text(part) + " are no part of the " +
                            std::to_string(plan.frames) + " frames that were planned");
  if (!is_border(plan, part.first) || !is_border(plan, part.last + 1))
    return invalid_argument("frames " + range_text(part) +
                            " are no part: it begins or ends within what is encoded together");
  return {};
}

Result<EncodePlan> look(FrameSource& source, const EncodeOptions& options, const EncodeProgress& progress) {
  if (needs_plan(source, options) || !source.frame_count()) {
    Result<std::optional<EncodePlan>> seen = look_through(source, progress);
    if (!seen) return seen.error();
    if (*seen) return std::move(**seen);
  } else if (source.rewind()) {
    EncodePlan plan;
    plan.frames = *source.frame_count();
    plan.stretches = {{0, plan.frames, source.mesh().vertex_count, mesh_hash(source), 0}};
    if (plan.frames == 0) return invalid_input("the sequence has no frames");
    return plan;
  }
  return invalid_argument(
      "the input can be read only once, so nothing of it can be encoded apart: write it "
      "to a file first");
}

/// The options with what the plan says of the whole.
Result<SettledOptions> settle(const FrameSource& source, const EncodeOptions& options,
                              const EncodePlan& plan) {
  if (Status status = check_encoding(source, options); !status.ok()) return status.error();
  if (source.frame_count() && *source.frame_count() != plan.frames) {
    return invalid_input("the input has " + std::to_string(*source.frame_count()) + " frames; it had " +
                         std::to_string(plan.frames) + " when it was planned");
  }
  return settle_options(source, options, &plan);
}

}  // namespace

Result<EncodePlan> plan_encoding(FrameSource& source, const EncodeOptions& options,
                                 const EncodeProgress& progress) {
  if (Status status = check_encoding(source, options); !status.ok()) return status.error();
  Result<EncodePlan> plan = look(source, options, progress);
  if (!plan) return plan;
  const Result<SettledOptions> settled = settle(source, options, *plan);
  if (!settled) return settled.error();
  tell_what_shaped(plan->stretches, settled->options.max_meshes);
  plan->frames_at_once = frames_at_once(settled->options);
  return plan;
}

std::vector<FrameRange> cut_into_parts(const EncodePlan& plan, std::uint32_t parts) {
  std::uint64_t units = 0;
  double left = 0;  // vertices of all frames that are in no part yet
  for (const SourceStretch& stretch : plan.stretches) {
    units += (stretch.frames + plan.frames_at_once - 1) / plan.frames_at_once;
    left += static_cast<double>(stretch.frames) * stretch.vertices;
  }
  std::vector<FrameRange> ranges;
  std::uint64_t parts_left = std::min<std::uint64_t>(parts, units), begin = 0;
  double taken = 0;
  for (const SourceStretch& stretch : plan.stretches) {
    const std::uint64_t end = stretch.first_frame + stretch.frames;
    for (std::uint64_t frame = stretch.first_frame; frame < end; --units) {
      const std::uint64_t next = std::min(end, frame + plan.frames_at_once);
      const double unit = static_cast<double>(next - frame) * stretch.vertices;
      // Ends a part before what would take it further from its share than it is now.
      const double share = left / static_cast<double>(parts_left);
      const bool is_full = taken > 0 && taken + unit / 2 > share;
      if (parts_left > 1 && frame > begin && (is_full || units < parts_left)) {
        ranges.push_back({begin, frame - 1});
        begin = frame;
        left -= taken;
        taken = 0;
        --parts_left;
      }
      taken += unit;
      frame = next;
    }
  }
  ranges.push_back({begin, plan.frames - 1});
  return ranges;
}

Result<EncodeReport> encode_part(FrameSource& source, const EncodeOptions& options, const EncodePlan& plan,
                                 const FrameRange& part, const ByteSink& sink,
                                 const EncodeProgress& progress) {
  try {
    if (Status status = check_plan(plan); !status.ok()) return status.error();
    if (Status status = check_part(plan, part); !status.ok()) return status.error();
    Result<SettledOptions> settled = settle(source, options, plan);
    if (!settled) return settled.error();
    if (frames_at_once(settled->options) != plan.frames_at_once)
      return invalid_argument("the options are not those of the plan");
    std::vector<NamedData> data(source.data().begin(), source.data().end());
    for (NamedData& one : data) {
      if (is_frame_data(one.name)) one = cut_frame_data(one, plan.frames, part);
    }
    add_data(settled->options.data, data);
    return PartEncoding(source, plan, part).run(*settled, sink, progress);
  } catch (const std::bad_alloc&) {
    return out_of_memory("there is not enough memory: use fewer frames per GOP or fewer threads");
  }
}

}  // namespace tvg
