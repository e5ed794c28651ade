#pragma once
#include <Eigen/Core>

namespace tvg {

/// The point of the triangle a b c nearest to `point`. Triangles without area are the segment or point they
/// cover.
Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace tvg
