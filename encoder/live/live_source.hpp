#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include <tvg/source.hpp>

namespace tvg::cli {

struct LiveInput {
  /// Frames per second at which a source that has all its frames already gives them out; absent for one whose
  /// frames come when they come.
  std::optional<double> pace;
  bool loop = false;        ///< begin again at the end, for ever
  bool open_ended = false;  ///< ends where it ends: a frame cut short is no error
};

/// Frames as they would come from something that happens now. Cannot be rewound, so that encode() looks at no
/// frame twice and gives each GOP a bounding box of its own.
class LiveSource final : public FrameSource {
 public:
  LiveSource(FrameSource& source, const LiveInput& input) : source_(source), input_(input) {}

  const Mesh& mesh() const override { return source_.mesh(); }
  Metadata metadata() const override { return source_.metadata(); }
  const Skeleton& skeleton() const override { return source_.skeleton(); }
  std::span<const float> joint_positions() const override { return source_.joint_positions(); }
  std::optional<std::uint64_t> frame_count() const override { return std::nullopt; }
  Result<bool> read_frame(std::span<float> positions) override;
  bool rewind() override { return false; }

  /// Where an open-ended input ended inside a frame: what it said about that.
  const std::optional<std::string>& cut_short() const { return cut_short_; }

 private:
  void wait_for_turn();

  FrameSource& source_;
  LiveInput input_;
  std::uint64_t frames_ = 0;
  std::chrono::steady_clock::time_point began_{};
  std::optional<std::string> cut_short_;
};

}  // namespace tvg::cli
