#pragma once
#include "simplify/flat_ring.hpp"
#include "simplify/half_edge_mesh.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// A point in a face, by weights of its corners, which are vertices of the cut mesh.
struct FacePoint {
  std::uint32_t face = 0;
  Face corners{};
  std::array<double, 3> weights{};  ///< [corner] none below 0, of sum 1
};

/// How a hole was filled: enough to carry points from the new faces back into those that were there.
struct Removal {
  std::uint32_t center = 0;             ///< these are vertices of the cut mesh
  std::vector<std::uint32_t> vertices;  ///< [place] of the ring
  std::vector<PlanePoint> plane;        ///< [place] where they lie when flat; the center at the origin
  std::vector<std::uint32_t> faces;     ///< [place] that went: the center, the vertex here, the next one
  std::vector<RingTriangle>
      triangles;  ///< [triangle] that came, by places; their faces are the first of `faces`
};

/// Carries a point in one of the faces that came into those that went, by where it lies in the plane.
void carry_back(const Removal& removal, FacePoint& point);

/// Where the vertices that are gone lie on the mesh that is left.
class Parameterization {
 public:
  explicit Parameterization(const HalfEdgeMesh& mesh);

  /// Before the mesh takes it: moves what lies in the faces that go into those that come, and the center too.
  void replace(const Removal& removal);
  /// Of a vertex of the cut mesh that is gone.
  const FacePoint& place(std::uint32_t vertex) const { return places_[vertex]; }

 private:
  std::vector<FacePoint> places_;                   ///< [vertex of the cut mesh]
  std::vector<std::vector<std::uint32_t>> inside_;  ///< [face] vertices that lie in it
  std::vector<std::uint32_t> moving_;
};

}  // namespace tvg
