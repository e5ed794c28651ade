#pragma once
#include "player/view/text_layer.hpp"
#include "player/view/view_extent.hpp"

namespace tvg::player {

/// Draws which way x (red), y (green) and z (blue) go as the camera sees them, around `place`, with the
/// letters where `letters` asks for them. ImGui must have a frame begun.
void draw_axes(ImDrawList& list, const CameraAxes& camera, const TextPlace& place, bool letters);

/// How far the drawing reaches from its place, in pixels, with letters of `size`.
float axes_reach(float size);

}  // namespace tvg::player
