#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

using Points = std::vector<Eigen::Vector3d>;

Eigen::Vector3d centroid(const Face& face, const Points& points);

/// Finds how far points are from a surface.
class SurfaceIndex {
 public:
  /// The indices of `faces` are valid.
  SurfaceIndex(std::span<const Face> faces, const Points& points);
  ~SurfaceIndex();

  /// The distance of `point` to the surface, given that it is at most `bound`; infinite bounds will do.
  double distance(const Eigen::Vector3d& point, double bound) const;

 private:
  struct Level;
  std::vector<std::unique_ptr<Level>> levels_;
};

}  // namespace tvg
