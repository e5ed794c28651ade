#include "metrics/surface_index.hpp"

#include "metrics/point_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <nanoflann.hpp>

// A triangle lies within its radius (the largest distance from its centroid to a corner) around its centroid,
// so one that is nearer than d to a point has its centroid nearer than d + radius. A kd-tree over centroids
// therefore finds every triangle that matters. Triangles are kept in one tree per power of two of the radius:
// a few large ones would otherwise widen every search.
namespace tvg {
namespace {

using Eigen::Vector3d;

struct Triangle {
  Vector3d a, b, c;
  Vector3d centroid;
  double radius = 0;

  double distance_to(const Vector3d& point) const {
    return (point - nearest_on_triangle(point, a, b, c)).norm();
  }
};

/// Triangles of similar size, as nanoflann reads them.
struct SizeClass {
  std::vector<Triangle> triangles;
  double radius = 0;

  std::size_t kdtree_get_point_count() const { return triangles.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return triangles[index].centroid[static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, SizeClass>, SizeClass,
                                                 3, std::uint32_t>;

/// Receives centroids from nanoflann; narrows the search as nearer triangles turn up.
class NearestTriangle {
 public:
  using DistanceType = double;

  NearestTriangle(const SizeClass& size_class, const Vector3d& point, double bound)
      : class_(size_class), point_(point), bound_(bound) {}

  double bound() const { return bound_; }

  // NOLINTBEGIN(readability-identifier-naming): nanoflann asks for these names.
  bool full() const { return true; }
  double worstDist() const {
    const double reach = (bound_ + class_.radius) * kRoundingMargin;
    return reach * reach;
  }
  bool addPoint(double squared_distance, std::uint32_t index) {
    const Triangle& triangle = class_.triangles[index];
    if (std::sqrt(squared_distance) <= (bound_ + triangle.radius) * kRoundingMargin) {
      bound_ = std::min(bound_, triangle.distance_to(point_));
    }
    return true;
  }
  // NOLINTEND(readability-identifier-naming)

 private:
  static constexpr double kRoundingMargin = 1 + 1e-9;

  const SizeClass& class_;
  const Vector3d& point_;
  double bound_;
};
}  // namespace

Vector3d centroid(const Face& face, const Points& points) {
  return (points[face[0]] + points[face[1]] + points[face[2]]) / 3;
}

struct SurfaceIndex::Level {
  SizeClass content;
  std::unique_ptr<Tree> tree;
};

SurfaceIndex::SurfaceIndex(std::span<const Face> faces, const Points& points) {
  // Large triangles first: they are few and leave a tight bound for the many.
  std::map<int, std::unique_ptr<Level>, std::greater<>> by_size;
  for (const Face& face : faces) {
    Triangle triangle{points[face[0]], points[face[1]], points[face[2]], centroid(face, points), 0};
    for (const Vector3d& corner : {triangle.a, triangle.b, triangle.c}) {
      triangle.radius = std::max(triangle.radius, (corner - triangle.centroid).norm());
    }
    auto& level = by_size[triangle.radius > 0 ? std::ilogb(triangle.radius) : -2000];
    if (!level) level = std::make_unique<Level>();
    level->content.radius = std::max(level->content.radius, triangle.radius);
    level->content.triangles.push_back(triangle);
  }
  for (auto& [size, stored] : by_size) {
    Level& level = *stored;
    level.tree = std::make_unique<Tree>(3, level.content, nanoflann::KDTreeSingleIndexAdaptorParams(8));
    levels_.push_back(std::move(stored));
  }
}

SurfaceIndex::~SurfaceIndex() = default;

double SurfaceIndex::distance(const Vector3d& point, double bound) const {
  for (const auto& level : levels_) {
    NearestTriangle nearest(level->content, point, bound);
    level->tree->findNeighbors(nearest, point.data(), {});
    bound = nearest.bound();
  }
  return bound;
}

}  // namespace tvg
