#include "metrics/hausdorff.hpp"

#include "metrics/point_triangle.hpp"

#include <algorithm>

namespace tvg {
namespace {

using Eigen::Vector3d;

/// A point of one surface and how far it can be from the other at most.
struct Sample {
  Vector3d point;
  double bound = 0;
};

}  // namespace

double directed_hausdorff(std::span<const Face> faces, const Points& from, const Points& to) {
  // Connectivity is shared: a sample is at most as far from the other surface as from its own image there.
  std::vector<Sample> samples;
  std::vector<bool> in_use(from.size(), false);
  for (const Face& face : faces) {
    const Vector3d middle = centroid(face, from);
    const double to_own_triangle =
        (middle - nearest_on_triangle(middle, to[face[0]], to[face[1]], to[face[2]])).norm();
    samples.push_back({middle, to_own_triangle});
    for (const std::uint32_t v : face) in_use[v] = true;
  }
  for (std::size_t v = 0; v < from.size(); ++v) {
    if (in_use[v]) samples.push_back({from[v], (from[v] - to[v]).norm()});
  }
  // Only a sample whose bound is above the distance found so far can raise it; the most promising come first.
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.bound > b.bound; });
  const SurfaceIndex surface(faces, to);
  double largest = 0;
  for (const Sample& sample : samples) {
    if (sample.bound <= largest) break;
    largest = std::max(largest, surface.distance(sample.point, sample.bound));
  }
  return largest;
}

}  // namespace tvg
