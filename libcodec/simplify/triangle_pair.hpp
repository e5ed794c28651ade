#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace tvg {

/// A triangle in space and the vertices it has.
struct SpaceTriangle {
  std::array<std::uint32_t, 3> vertices{};
  std::array<Eigen::Vector3d, 3> points;
};

/// Whether two triangles have more in common than the vertices that both name: they pass through each other,
/// or lie in one plane and overlap. Touching is none of it, nor is what comes within 1e-10. Degenerate
/// triangles meet nothing.
bool triangles_meet(const SpaceTriangle& a, const SpaceTriangle& b);

}  // namespace tvg
