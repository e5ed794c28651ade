#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

/// The frames of `range` of another source; the range lies within its frames.
class FrameRangeSource final : public SourceDecorator {
 public:
  FrameRangeSource(std::unique_ptr<FrameSource> source, const FrameRange& range);

  std::span<const NamedData> data() const override { return data_; }

  std::optional<std::uint64_t> frame_count() const override { return range_.last - range_.first + 1; }
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override;
  bool rewind() override;

 private:
  Status go_to_range();

  FrameRange range_;
  std::vector<NamedData> data_;
  bool skipped_ = false;      // whether the frames before the range have been passed over
  std::uint64_t frames_ = 0;  // frames of the range read so far
};

}  // namespace tvg::cli
