#include "cli/frames_in_memory.hpp"

#include "tool/tool_error.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

class FrameHolder {
 public:
  FrameHolder(FrameSource& source, const HoldSettings& settings, ProgressBar& bar)
      : source_(source), settings_(settings), bar_(bar) {
    held_.sequence.mesh = source.mesh();
    held_.sequence.metadata = source.metadata();
    const std::uint64_t joints = settings.joints ? source.skeleton().joint_names.size() : 0;
    const std::uint64_t bytes = 3 * sizeof(float) * (source.mesh().vertex_count + joints);
    most_ = std::max<std::uint64_t>(1, settings.most_bytes / std::max<std::uint64_t>(1, bytes));
  }

  FramesInMemory run() {
    const std::optional<std::uint64_t> total = source_.frame_count();
    if (total && *total > most_) {
      hold_some(*total);
    } else {
      hold_all();
    }
    if (held_.numbers.empty())
      throw ToolError(ExitStatus::kInvalidInput, settings_.names + ": there are no frames");
    return std::move(held_);
  }

 private:
  void hold_all() {
    for (std::uint64_t number = 0; hold(number); ++number) {
      held_.total = number + 1;
      if (held_.total <= most_) continue;
      const std::uint64_t total = held_.total + count_rest();
      held_.sequence.frames.clear();
      held_.joints.clear();
      held_.numbers.clear();
      return hold_some(total);
    }
  }

  void hold_some(std::uint64_t total) {
    if (!source_.rewind()) {
      throw ToolError(
          ExitStatus::kUsage,
          fmt::format("{}: frames that come through a pipe are all held in memory, and more than {} "
                      "do not fit: write them to a file first, or raise --memory",
                      settings_.names, most_));
    }
    held_.total = total;
    std::uint64_t next = 0;
    for (std::uint64_t i = 0; i < most_; ++i) {
      const std::uint64_t number = most_ == 1 ? total / 2 : i * (total - 1) / (most_ - 1);
      if (const Status skipped = source_.skip_frames(number - next); !skipped.ok()) fail(skipped.error());
      if (!hold(number)) fail({ErrorCode::kInvalidInput, "there are fewer frames than it says"});
      next = number + 1;
    }
  }

  /// Reads a frame, which has this number; false at the end.
  bool hold(std::uint64_t number) {
    FramePositions frame(3 * std::size_t{source_.mesh().vertex_count});
    if (!read(frame)) return false;
    held_.sequence.frames.push_back(std::move(frame));
    held_.numbers.push_back(number);
    const std::span<const float> joints = source_.joint_positions();
    if (settings_.joints) held_.joints.emplace_back(joints.begin(), joints.end());
    bar_.update(number + 1, source_.frame_count());
    return true;
  }

  std::uint64_t count_rest() {
    std::uint64_t count = 0;
    for (FramePositions frame(3 * std::size_t{source_.mesh().vertex_count}); read(frame);) ++count;
    return count;
  }

  bool read(FramePositions& frame) {
    const Result<bool> more = source_.read_frame(frame);
    if (!more) fail(more.error());
    return *more;
  }

  [[noreturn]] void fail(const Error& error) const { throw tool_error(settings_.names, error); }

  FrameSource& source_;
  const HoldSettings& settings_;
  ProgressBar& bar_;
  FramesInMemory held_;
  std::uint64_t most_ = 1;  ///< frames
};

}  // namespace

FramesInMemory hold_frames(FrameSource& source, const HoldSettings& settings, ProgressBar& bar) {
  return FrameHolder(source, settings, bar).run();
}

}  // namespace tvg::cli
