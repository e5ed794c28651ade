#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include <tvg/source.hpp>

namespace tvg::cli {

/// A source that can pass over frames without decoding them.
class SkippableSource : public FrameSource {
 public:
  /// Passes over `count` frames, which are within the sequence.
  virtual Status skip_frames(std::uint64_t count) = 0;
};

/// The frames of `range` of another source; the range lies within its frames.
class FrameRangeSource final : public FrameSource {
 public:
  FrameRangeSource(std::unique_ptr<SkippableSource> source, const FrameRange& range)
      : source_(std::move(source)), range_(range) {}

  const Mesh& mesh() const override { return source_->mesh(); }
  Metadata metadata() const override { return source_->metadata(); }
  const Skeleton& skeleton() const override { return source_->skeleton(); }
  std::span<const float> joint_positions() const override { return source_->joint_positions(); }
  std::optional<std::uint64_t> frame_count() const override { return range_.last - range_.first + 1; }
  Result<bool> read_frame(std::span<float> positions) override;
  bool rewind() override;

 private:
  std::unique_ptr<SkippableSource> source_;
  FrameRange range_;
  bool skipped_ = false;      // whether the frames before the range have been passed over
  std::uint64_t frames_ = 0;  // frames of the range read so far
};

}  // namespace tvg::cli
