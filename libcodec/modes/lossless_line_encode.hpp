#pragma once
#include "modes/lossless_header.hpp"

#include <span>

#include <tvg/types.hpp>

// What encoding without loss needs to know of numbers before it codes them.
namespace tvg {

/// The line with the fewest numbers that has all of these frames' coordinates, which are finite.
LineChoice line_of(std::span<const FramePositions> frames);

/// How many bits the reference shape of a sequence with this first frame should have: finer than that it
/// would tell what the frame does not hold, or what is cheaper to tell with the frame. A frame has vertices.
int lossless_shape_bits(std::span<const float> first_frame);

}  // namespace tvg
