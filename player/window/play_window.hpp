#pragma once
#include "player/window/play_options.hpp"

namespace tvg::player {

/// Opens a window and plays until it is closed. Throws ToolError: kOther where there can be no window, kIo
/// where a file cannot be opened, and what ended a stream that never showed a frame.
void run_play_window(const PlayOptions& options);

}  // namespace tvg::player
