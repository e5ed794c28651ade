#pragma once
#include "player/window/interface.hpp"

// The panels over the scene that only show something. An ImGui frame must be begun.
namespace tvg::player {

/// What the stream is and how playing goes, in the upper right corner.
void draw_info(const PlayerSnapshot& player, const InterfaceFacts& facts);
/// Bits of the frames around the one shown, as a strip of bars over the controls, `bottom` pixels from the
/// top. Returns where the strip begins.
float draw_chart(const PlayerSnapshot& player, const InterfaceFacts& facts, float bottom);
/// Keys and what they do.
void draw_help();
/// Why nothing moves, in the middle: opening, buffering, or an error.
void draw_state(const PlayerSnapshot& player);
/// What to do while no stream is open.
void draw_welcome();
/// A passing line at the top.
void draw_notice(const std::string& notice);

}  // namespace tvg::player
