#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// A vertex that is gone and where it lies between three that are there; all are the original's.
struct PlacedVertex {
  std::uint32_t vertex = 0;
  Face corners{};
  std::array<double, 3> weights{};
};

/// The paper's Eq. 8 at several levels, [level][frame]: the sum over the level's vertices of the squared
/// distances of their places from the planes of the original's faces around them, in positions scaled so that
/// the largest extent over all frames is 1. Faces without area have no plane.
std::vector<std::vector<double>> quadric_errors(const Mesh& mesh, std::span<const FramePositions> frames,
                                                std::span<const std::vector<PlacedVertex>> levels);

}  // namespace tvg
