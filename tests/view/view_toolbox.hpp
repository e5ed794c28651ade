#pragma once
#include "player/render/picture.hpp"

#include <functional>
#include <optional>

#include <tvg/source.hpp>

namespace tvg::player::testing {

inline constexpr int kWidth = 256;
inline constexpr int kHeight = 192;

/// A frame of a sequence in memory, as the painter takes it.
inline ShownFrame shown_frame(const Sequence& sequence, std::size_t number) {
  ShownFrame frame;
  frame.number = number;
  frame.mesh = std::make_shared<const Mesh>(sequence.mesh);
  frame.positions = sequence.frames.at(number);
  return frame;
}

/// The camera of all test pictures: the whole sequence, seen from where users see it first.
inline OrbitCamera camera_for(const Sequence& sequence, double aspect) {
  OrbitCamera camera;
  ViewExtent extent = camera.extent(aspect);
  for (const FramePositions& frame : sequence.frames) extent.extend(frame);
  camera.fit(extent);
  return camera;
}

inline BoundingBox bounds_of(const Sequence& sequence) {
  BoundingBox bounds;
  for (const FramePositions& frame : sequence.frames) bounds.extend(frame);
  return bounds;
}

}  // namespace tvg::player::testing
