#include "encoder/importers/frame_range.hpp"

#include "cli/tool_error.hpp"

#include <fmt/format.h>

namespace tvg::cli {

void check_frame_range(const FrameRange& range, std::uint64_t frame_count, const std::string& input) {
  if (range.first > range.last) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("frames {}-{}: the first comes after the last", range.first, range.last));
  }
  if (range.last >= frame_count) {
    throw ToolError(ExitStatus::kUsage, fmt::format("frames {}-{} are asked for, but {} has the frames 0-{}",
                                                    range.first, range.last, input, frame_count - 1));
  }
}

Result<bool> FrameRangeSource::read_frame(std::span<float> positions) {
  if (frames_ == range_.last - range_.first + 1) return false;
  if (!skipped_) {
    const Status skipped = source_->skip_frames(range_.first);
    if (!skipped.ok()) return skipped.error();
    skipped_ = true;
  }
  Result<bool> read = source_->read_frame(positions);
  if (read && *read) ++frames_;
  return read;
}

bool FrameRangeSource::rewind() {
  if (!source_->rewind()) return false;
  skipped_ = false;
  frames_ = 0;
  return true;
}

}  // namespace tvg::cli
