#include "simplify/triangle_pair.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tvg {
namespace {

using Eigen::Vector3d;

/// In units of a mesh whose extent is about 1: far below what float32 tells apart, far above rounding.
constexpr double kTouching = 1e-10;

double volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// Whether the segment passes through the triangle, from one side of its plane to the other.
bool passes_through(const Vector3d& p, const Vector3d& q, const SpaceTriangle& triangle,
                    const Vector3d& normal) {
  const auto& [a, b, c] = triangle.points;
  const double at_p = normal.dot(p - a), at_q = normal.dot(q - a);
  if (std::min(at_p, at_q) > -kTouching || std::max(at_p, at_q) < kTouching) return false;
  const double ab = volume(p, q, a, b), bc = volume(p, q, b, c), ca = volume(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// Whether all of `other` lies beyond a side of the triangle, in the plane both share.
bool lies_beside(const SpaceTriangle& triangle, const Vector3d& normal, const SpaceTriangle& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& from = triangle.points[k];
    const Vector3d side = triangle.points[(k + 1) % 3] - from;
    const Vector3d inwards = normal.cross(side) / side.norm();
    const auto within = [&](const Vector3d& point) { return inwards.dot(point - from) > kTouching; };
    if (std::none_of(other.points.begin(), other.points.end(), within)) return true;
  }
  return false;
}

bool is_shared(std::uint32_t vertex, const SpaceTriangle& other) {
  return std::find(other.vertices.begin(), other.vertices.end(), vertex) != other.vertices.end();
}

bool side_passes_through(const SpaceTriangle& sides, const SpaceTriangle& triangle, const Vector3d& normal) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    // From a vertex that both have, a side leaves the triangle's plane and does not come back.
    if (is_shared(sides.vertices[k], triangle) || is_shared(sides.vertices[next], triangle)) continue;
    if (passes_through(sides.points[k], sides.points[next], triangle, normal)) return true;
  }
  return false;
}

bool in_plane(const SpaceTriangle& triangle, const Vector3d& normal, const SpaceTriangle& other) {
  return std::all_of(other.points.begin(), other.points.end(), [&](const Vector3d& point) {
    return std::abs(normal.dot(point - triangle.points[0])) <= kTouching;
  });
}

}  // namespace

bool triangles_meet(const SpaceTriangle& a, const SpaceTriangle& b) {
  Vector3d of_a = (a.points[1] - a.points[0]).cross(a.points[2] - a.points[0]);
  Vector3d of_b = (b.points[1] - b.points[0]).cross(b.points[2] - b.points[0]);
  if (!(of_a.squaredNorm() > 0) || !(of_b.squaredNorm() > 0)) return false;
  of_a.normalize();
  of_b.normalize();
  if (side_passes_through(a, b, of_b) || side_passes_through(b, a, of_a)) return true;
  if (!in_plane(a, of_a, b) || !in_plane(b, of_b, a)) return false;
  return !lies_beside(a, of_a, b) && !lies_beside(b, of_b, a);
}

}  // namespace tvg
