#include "encoder/importers/frame_range.hpp"

#include "encoder/importers/frame_times.hpp"

#include <utility>

namespace tvg::cli {

FrameRangeSource::FrameRangeSource(std::unique_ptr<FrameSource> source, const FrameRange& range)
    : SourceDecorator(std::move(source)), range_(range) {
  for (const NamedData& data : SourceDecorator::data()) {
    data_.push_back(data.name == kTimesData ? cut_times(data, range.first, range.last - range.first + 1)
                                            : data);
  }
}

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
