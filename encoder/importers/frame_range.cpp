#include "encoder/importers/frame_range.hpp"

namespace tvg::cli {

Status FrameRangeSource::go_to_range() {
  if (skipped_) return {};
  Status status = SourceDecorator::skip_frames(range_.first);
  skipped_ = status.ok();
  return status;
}

Result<bool> FrameRangeSource::read_frame(std::span<float> positions) {
  if (frames_ == range_.last - range_.first + 1) return false;
  if (const Status status = go_to_range(); !status.ok()) return status.error();
  Result<bool> read = SourceDecorator::read_frame(positions);
  if (read && *read) ++frames_;
  return read;
}

Status FrameRangeSource::skip_frames(std::uint64_t count) {
  if (Status status = go_to_range(); !status.ok()) return status;
  frames_ += count;
  return SourceDecorator::skip_frames(count);
}

bool FrameRangeSource::rewind() {
  if (!SourceDecorator::rewind()) return false;
  skipped_ = false;
  frames_ = 0;
  return true;
}

}  // namespace tvg::cli
