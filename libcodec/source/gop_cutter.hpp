#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// A run of frames in memory.
struct GopFrames {
  std::vector<FramePositions> frames;      ///< [frame][vertex][xyz], in the order of the input mesh
  std::vector<std::vector<float>> joints;  ///< [frame][joint][xyz]; empty unless the measure uses them
  /// [frame][animated attribute][value][component]
  std::vector<std::vector<std::vector<float>>> values;
};

/// The frames of a GOP. They are shared: those of one GOP may mark the next.
struct GopContent {
  std::shared_ptr<const GopFrames> content;
  std::shared_ptr<const GopFrames> marked_by;  ///< what the measure looks at
  std::uint64_t first_frame = 0;               ///< counted from the first that was added
};

/// Cuts the frames of one mesh into GOPs. It takes frames that were checked.
class GopCutter {
 public:
  /// `low_delay`: as Importance has it. `frames_before`, whole GOPs, were cut elsewhere; `gop_before` is the
  /// last of them, if it is to mark the next.
  GopCutter(std::uint32_t gop_frames, bool low_delay, std::uint64_t frames_before = 0,
            std::shared_ptr<const GopFrames> gop_before = {})
      : gop_frames_(gop_frames),
        low_delay_(low_delay),
        frames_(frames_before),
        previous_(std::move(gop_before)) {}

  /// Takes the next frame, the values of its animated attributes and, where the measure uses them, its
  /// joints; gives the GOP that it completes.
  std::optional<GopContent> add(FramePositions frame, std::vector<float> joints,
                                std::vector<std::vector<float>> values = {});
  /// The GOP of the frames that are left, if any.
  std::optional<GopContent> flush();

  /// Frames taken, those before among them.
  std::uint64_t frames() const { return frames_; }

 private:
  std::uint32_t gop_frames_;
  bool low_delay_;
  std::uint64_t frames_;
  std::shared_ptr<GopFrames> present_;
  std::shared_ptr<const GopFrames> previous_;
};

}  // namespace tvg
