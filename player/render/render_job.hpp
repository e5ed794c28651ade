#pragma once
#include "player/render/render_options.hpp"

namespace tvg::player {

/// Draws what the options ask for and writes it. Throws ToolError.
void render(const RenderOptions& options);

}  // namespace tvg::player
