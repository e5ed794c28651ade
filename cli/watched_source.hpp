#pragma once
#include <optional>

#include <tvg/source.hpp>

namespace tvg::cli {

/// Passes frames on and keeps the source's own error, which names its file: the encoder's do not.
class WatchedSource final : public FrameSource {
 public:
  explicit WatchedSource(FrameSource& source) : source_(source) {}

  const Mesh& mesh() const override { return source_.mesh(); }
  Metadata metadata() const override { return source_.metadata(); }
  const Skeleton& skeleton() const override { return source_.skeleton(); }
  std::span<const float> joint_positions() const override { return source_.joint_positions(); }
  std::optional<std::uint64_t> frame_count() const override { return source_.frame_count(); }
  Result<bool> read_frame(std::span<float> positions) override {
    Result<bool> read = source_.read_frame(positions);
    if (!read) error_ = read.error();
    return read;
  }
  bool rewind() override { return source_.rewind(); }

  /// What read_frame() failed with, if it did.
  const std::optional<Error>& error() const { return error_; }

 private:
  FrameSource& source_;
  std::optional<Error> error_;
};

}  // namespace tvg::cli
