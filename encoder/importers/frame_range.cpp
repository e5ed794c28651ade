#include "encoder/importers/frame_range.hpp"

namespace tvg::cli {

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
