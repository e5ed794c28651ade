#include "metrics/point_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace tvg {
namespace {

using Eigen::Vector3d;

Vector3d nearest_on_segment(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double squared = along.squaredNorm();
  if (squared == 0) return a;
  return a + std::clamp((point - a).dot(along) / squared, 0.0, 1.0) * along;
}

}  // namespace

Vector3d nearest_on_triangle(const Vector3d& point, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (squared > 0) {
    // Inside when the point lies on the inner side of the three planes through an edge and the normal.
    const bool inside = normal.dot((b - a).cross(point - a)) >= 0 &&
                        normal.dot((c - b).cross(point - b)) >= 0 &&
                        normal.dot((a - c).cross(point - c)) >= 0;
    if (inside) return point - normal.dot(point - a) / squared * normal;
  }
  Vector3d nearest = nearest_on_segment(point, a, b);
  for (const Vector3d& other : {nearest_on_segment(point, b, c), nearest_on_segment(point, c, a)}) {
    if ((point - other).squaredNorm() < (point - nearest).squaredNorm()) nearest = other;
  }
  return nearest;
}

}  // namespace tvg
