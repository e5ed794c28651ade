#pragma once
#include "player/frames/shown_frames.hpp"
#include "player/overlay/overlay_colours.hpp"

#include <memory>
#include <optional>

namespace tvg::player {

/// Frames for an overlay that has to know a GOP whole: `colours` is shown all of a GOP before its first frame
/// is given out. `gops` gives out whole GOPs; of these, frames of `wanted` are passed on. One GOP is in
/// memory at a time; a ToolError (kOther) where that is more than 4 GiB. `colours` must outlive the frames.
std::unique_ptr<ShownFrames> with_whole_gops(std::unique_ptr<ShownFrames> gops,
                                             std::optional<FrameRange> wanted, OverlayColours& colours);

}  // namespace tvg::player
