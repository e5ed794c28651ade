#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <tvg/geometry.hpp>
#include <tvg/measure.hpp>
#include <tvg/source.hpp>

namespace tvg {

/// A run of frames in memory.
struct GopFrames {
  std::vector<FramePositions> frames;      ///< [frame][vertex][xyz], in the order of the input mesh
  std::vector<std::vector<float>> joints;  ///< [frame][joint][xyz]; empty unless the measure uses them
};

/// The frames of a GOP. They are shared: those of one GOP may mark the next.
struct GopContent {
  std::shared_ptr<const GopFrames> content;
  std::shared_ptr<const GopFrames> marked_by;  ///< what the measure looks at
  std::uint64_t first_frame = 0;               ///< counted from the source's first
  BoundingBox box;
};

/// Cuts a source into GOPs. `source` and `importance` must outlive it.
class GopReader {
 public:
  GopReader(FrameSource& source, std::uint32_t gop_frames, const Importance& importance)
      : source_(source), importance_(importance), gop_frames_(gop_frames) {}

  /// The next GOP, of `gop_frames` frames or, at the source's end, of those that are left; nothing after the
  /// last. Fails as the source does, and with kInvalidInput for what no lattice can hold and for a source
  /// without frames.
  Result<std::optional<GopContent>> next();

 private:
  FrameSource& source_;
  const Importance& importance_;
  std::uint32_t gop_frames_;
  std::uint64_t frames_read_ = 0;
  std::shared_ptr<const GopFrames> previous_;
  bool at_end_ = false;
};

}  // namespace tvg
