#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/simplify.hpp>

namespace tvg {

/// The paper's Eq. 7 on a mesh that is partly gone, [vertex]: lambda times the area of the one ring and
/// 1 - lambda times its curvature (Eq. 1), both the mean over the frames and relative to the largest of the
/// mesh. 0 for vertices without faces.
std::vector<double> maps_priorities(const Mesh& mesh, std::span<const FramePositions> frames, double lambda);

}  // namespace tvg
