#pragma once
#include "player/view/look.hpp"
#include "tool/measured_frame.hpp"

#include <string>

#include <tvg/source.hpp>

namespace tvg::player {

/// Draws a measured frame to a PNG without a display: at the left the cost as a heat map, at the right what
/// it marks, with the skeleton over both where the measure looked at one. `criteria` stands in the legend.
/// Throws ToolError: kOther where this machine cannot draw, kIo.
void draw_measure_picture(const std::string& path, const FrameSource& source, const cli::MeasuredFrame& frame,
                          const std::string& criteria, const Look& look);

}  // namespace tvg::player
