#pragma once
#include <span>

#include <tvg/source.hpp>

namespace tvg {

/// The diagonal of the box around all these frames, in the mesh's units.
double frames_diagonal(std::span<const FramePositions> frames);

}  // namespace tvg
