#pragma once
#include "player/view/camera.hpp"

#include <cstdint>
#include <span>

#include <tvg/skeleton.hpp>

struct ImDrawList;

namespace tvg::player {

/// A skeleton in a frame.
struct Pose {
  const Skeleton& skeleton;
  std::span<const float> joints;              ///< [joint][xyz]
  std::span<const std::uint8_t> highlighted;  ///< [joint]: 1 for those to stand out
};

/// A part of a picture in pixels, from its upper left corner.
struct PictureArea {
  float left = 0;
  float top = 0;
  float width = 0;
  float height = 0;
};

/// Draws a skeleton over what the camera shows in `area`, through the surface: lines from parents to children
/// and a dot per joint, orange and larger where it is highlighted. `size` is that of the picture's text.
/// ImGui must have a frame begun.
void draw_pose(ImDrawList& list, const OrbitCamera& camera, const PictureArea& area, const Pose& pose,
               float size);

}  // namespace tvg::player
