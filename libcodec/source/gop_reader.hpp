#pragma once
#include "source/gop_cutter.hpp"

#include <cstdint>
#include <optional>

#include <tvg/measure.hpp>
#include <tvg/source.hpp>

namespace tvg {

/// Cuts a source into GOPs. `source` must outlive it.
class GopReader {
 public:
  GopReader(FrameSource& source, std::uint32_t gop_frames, const Importance& importance)
      : source_(source), with_joints_(uses_skeleton(importance)), cutter_(gop_frames, importance.low_delay) {}

  /// The next GOP, of `gop_frames` frames or, at the source's end, of those that are left; nothing after the
  /// last. Fails as the source does, and with kInvalidInput for what no lattice can hold and for a source
  /// without frames.
  Result<std::optional<GopContent>> next();

 private:
  FrameSource& source_;
  bool with_joints_;
  GopCutter cutter_;
  bool at_end_ = false;
};

}  // namespace tvg
