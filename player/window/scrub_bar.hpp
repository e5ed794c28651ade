#pragma once
#include "player/playback/player.hpp"

#include <cstdint>
#include <optional>

namespace tvg::player {

/// Draws the stream from its first to its last frame, `width` pixels wide: what is buffered and decoded,
/// where GOPs begin, what is damaged, what loops, and where playing is. Returns the frame that the user drags
/// to. A window of ImGui's must be begun.
std::optional<std::uint64_t> draw_scrub_bar(const PlayerSnapshot& player, float width);

}  // namespace tvg::player
