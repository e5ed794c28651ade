#pragma once
#include "player/view/image.hpp"

#include <string>

namespace tvg::player {

/// Draws the first frame of a stream that shows anything, as the page of `tvg page` shows it before it plays
/// (web/page/stage.ts has the same camera), on a transparent background, which suits dark pages and light
/// ones. `stream`: a file. Sizes in pixels. Throws ToolError: kOther where this machine cannot draw, and as
/// open_frames() does.
Image draw_poster(const std::string& stream, int width, int height);

}  // namespace tvg::player
