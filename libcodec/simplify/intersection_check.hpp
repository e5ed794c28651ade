#pragma once
#include "simplify/face_grid.hpp"
#include "simplify/half_edge_mesh.hpp"
#include "simplify/triangle_pair.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Says of a hole, in some frames, whether faces that fill it pass through others where those that were there
/// did not: through these, or through such as share a vertex with them.
class IntersectionCheck {
 public:
  /// Looks at so many of the frames, evenly spread, the first and the last among them; at all where there are
  /// not so many.
  IntersectionCheck(const HalfEdgeMesh& mesh, std::span<const FramePositions> frames, std::uint32_t count);

  /// Sorts the faces that are there anew, by the size they now have.
  void rebuild();
  bool allows(const Ring& ring, std::span<const RingTriangle> triangles);
  /// Learns of the faces that fill a hole, once they are in the mesh.
  void filled(std::span<const std::uint32_t> faces);

 private:
  SpaceTriangle triangle(std::size_t frame, const Face& face) const;
  FloatBox box(std::size_t frame, const Face& face) const;
  const float* point(std::size_t frame, std::uint32_t vertex) const {
    return points_.data() + 3 * (frame_count_ * vertex + frame);
  }
  bool allows_in(std::size_t frame, const Ring& ring, std::span<const Face> faces);
  bool met_before(std::size_t frame, const Ring& ring, const Face& face) const;

  const HalfEdgeMesh& mesh_;
  std::size_t frame_count_ = 0;
  std::vector<float> points_;         ///< [vertex][frame][xyz], scaled so that the largest extent is 1
  std::vector<FaceGrid> grids_;       ///< [frame]
  std::vector<std::uint32_t> asked_;  ///< [face] when it was last looked at
  std::uint32_t question_ = 0;
  std::vector<std::uint32_t> found_;
};

}  // namespace tvg
