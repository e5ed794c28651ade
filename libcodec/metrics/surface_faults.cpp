#include "base/errors.hpp"
#include "metrics/frame_checks.hpp"
#include "metrics/surface_index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include <tvg/metrics.hpp>

namespace tvg {
namespace {

using Box = Eigen::AlignedBox3d;
using Eigen::Vector3d;

/// Six times the volume of the tetrahedron of these points; 0 where it is as small as rounding makes it.
double volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d u = b - a, v = c - a, w = d - a;
  constexpr double kRounding = 1e-12;
  const double result = u.cross(v).dot(w);
  return std::abs(result) <= kRounding * u.norm() * v.norm() * w.norm() ? 0 : result;
}

/// Whether the segment p q passes through the triangle from one side to the other.
bool pierces(const Vector3d& p, const Vector3d& q, const std::array<Vector3d, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  if (!(volume(a, b, c, p) * volume(a, b, c, q) < 0)) return false;
  const double ab = volume(p, q, a, b), bc = volume(p, q, b, c), ca = volume(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// A hierarchy of boxes around faces.
class FaceBoxes {
 public:
  FaceBoxes(std::span<const Face> faces, const Points& points) : order_(faces.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    for (const Face& face : faces) {
      Box box;
      for (const std::uint32_t v : face) box.extend(points[v]);
      boxes_.push_back(box);
    }
    if (!faces.empty()) build(0, faces.size());
  }

  /// Calls visit(a, b) once for each two faces whose boxes meet.
  template <class Visit>
  void visit_pairs(Visit&& visit) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> left;
    if (!nodes_.empty()) left.emplace_back(0, 0);
    while (!left.empty()) {
      const auto [first, second] = left.back();
      left.pop_back();
      const Node& a = nodes_[first];
      const Node& b = nodes_[second];
      if (first != second && !a.box.intersects(b.box)) continue;
      if (a.is_leaf() && b.is_leaf()) {
        visit_leaves(a, b, first == second, visit);
      } else if (first == second) {
        left.emplace_back(a.left, a.left);
        left.emplace_back(a.right, a.right);
        left.emplace_back(a.left, a.right);
      } else if (b.is_leaf() || (!a.is_leaf() && a.end - a.begin >= b.end - b.begin)) {
        left.emplace_back(a.left, second);
        left.emplace_back(a.right, second);
      } else {
        left.emplace_back(first, b.left);
        left.emplace_back(first, b.right);
      }
    }
  }

 private:
  struct Node {
    Box box;
    std::size_t begin = 0, end = 0;  ///< in order_
    std::uint32_t left = 0, right = 0;

    bool is_leaf() const { return left == 0; }
  };

  std::uint32_t build(std::size_t begin, std::size_t end) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    Node node;
    node.begin = begin;
    node.end = end;
    for (std::size_t i = begin; i < end; ++i) node.box.extend(boxes_[order_[i]]);
    nodes_.push_back(node);
    constexpr std::size_t kLeaf = 4;
    if (end - begin <= kLeaf) return number;
    Eigen::Index axis = 0;
    node.box.sizes().maxCoeff(&axis);
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [this, axis](std::uint32_t a, std::uint32_t b) {
      return boxes_[a].center()[axis] < boxes_[b].center()[axis];
    });
    const std::uint32_t left = build(begin, middle);
    const std::uint32_t right = build(middle, end);
    nodes_[number].left = left;
    nodes_[number].right = right;
    return number;
  }

  template <class Visit>
  void visit_leaves(const Node& a, const Node& b, bool same, Visit&& visit) const {
    for (std::size_t i = a.begin; i < a.end; ++i) {
      for (std::size_t j = same ? i + 1 : b.begin; j < b.end; ++j) {
        if (boxes_[order_[i]].intersects(boxes_[order_[j]])) visit(order_[i], order_[j]);
      }
    }
  }

  std::vector<Box> boxes_;  ///< [face]
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

class FaultCounter {
 public:
  FaultCounter(const Mesh& mesh, std::span<const float> positions, double fold)
      : faces_(mesh.faces), fold_cosine_(std::cos(fold * std::numbers::pi / 180)) {
    load_points(positions, points_);
    for (const auto& [a, b, c] : faces_) {
      normals_.emplace_back((points_[b] - points_[a]).cross(points_[c] - points_[a]).normalized());
    }
  }

  SurfaceFaults count() const {
    SurfaceFaults faults;
    FaceBoxes(faces_, points_).visit_pairs([&](std::uint32_t a, std::uint32_t b) {
      if (has_area(a) && has_area(b) && intersect(faces_[a], faces_[b])) ++faults.intersections;
    });
    faults.folds = folds();
    return faults;
  }

 private:
  bool has_area(std::uint32_t face) const { return normals_[face].squaredNorm() > 0.5; }

  std::array<Vector3d, 3> corners(const Face& face) const {
    return {points_[face[0]], points_[face[1]], points_[face[2]]};
  }

  /// Faces that meet at a vertex can pass through each other only where the edges across from it do.
  bool intersect(const Face& a, const Face& b) const {
    const auto is_of = [](const Face& face, std::uint32_t v) {
      return std::find(face.begin(), face.end(), v) != face.end();
    };
    const auto shared = std::count_if(a.begin(), a.end(), [&](std::uint32_t v) { return is_of(b, v); });
    if (shared > 1) return false;
    const auto edge_pierces = [&](const Face& from, const Face& to) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = from[k], q = from[(k + 1) % 3];
        if (is_of(to, p) || is_of(to, q)) continue;
        if (pierces(points_[p], points_[q], corners(to))) return true;
      }
      return false;
    };
    return edge_pierces(a, b) || edge_pierces(b, a);
  }

  /// A side of a face, from the lower vertex to the higher one or back.
  struct Side {
    std::pair<std::uint32_t, std::uint32_t> edge;
    std::uint32_t face = 0;
    bool upwards = false;
  };

  std::uint64_t folds() const {
    std::vector<Side> sides;
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = faces_[face][k], q = faces_[face][(k + 1) % 3];
        if (p != q) sides.push_back({std::minmax(p, q), face, p < q});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::pair(a.edge, a.face) < std::pair(b.edge, b.face);
    });
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t end = i + 1;
      while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
      if (end - i == 2 && is_fold(sides[i], sides[i + 1])) ++count;
      i = end;
    }
    return count;
  }

  bool is_fold(const Side& a, const Side& b) const {
    if (!has_area(a.face) || !has_area(b.face)) return false;
    // Neighbours that are turned the same way round pass their edge in opposite directions.
    const double turned = a.upwards == b.upwards ? -1 : 1;
    return turned * normals_[a.face].dot(normals_[b.face]) < fold_cosine_;
  }

  const std::vector<Face>& faces_;
  double fold_cosine_;
  Points points_;
  Points normals_;  ///< [face] of length 1; 0 of a face without area
};

}  // namespace

Result<SurfaceFaults> surface_faults(const Mesh& mesh, std::span<const float> positions, double fold) {
  if (!(fold >= 0 && fold <= 180)) return invalid_argument("the angle of a fold must be 0 to 180 degrees");
  if (!faces_are_valid(mesh)) return invalid_input("a face of the mesh names a vertex that does not exist");
  if (Status checked = check_positions(mesh, positions, "mesh"); !checked.ok()) return checked.error();
  return FaultCounter(mesh, positions, fold).count();
}

}  // namespace tvg
