#pragma once
#include "simplify/half_edge_mesh.hpp"
#include "simplify/parameterization.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <tvg/simplify.hpp>

namespace tvg {

/// The way from an original to a simplified mesh, and back.
class RemovalHistory {
 public:
  /// `mesh` is what the removals left.
  RemovalHistory(const HalfEdgeMesh& mesh, std::vector<Removal> removals);

  /// [face of the simplified mesh] its number, and its corners as the cut mesh has them.
  const std::vector<FacePoint>& base() const { return base_; }
  /// Carries points in faces of the simplified mesh through all removals, the last one first, into faces of
  /// the original, [point].
  std::vector<SurfacePlace> on_original(std::vector<FacePoint> points) const;
  std::size_t vertex_count() const { return vertex_count_; }  ///< of the original
  /// [vertex of the original] a face that has it; of those without a face, anything.
  const std::vector<SurfacePlace>& at_vertices() const { return at_vertices_; }

 private:
  std::size_t vertex_count_;
  std::vector<Face> faces_;             ///< [face of the cut mesh] before anything was removed
  std::vector<std::uint32_t> face_of_;  ///< [face of the cut mesh] the original's
  std::vector<Removal> removals_;
  std::vector<FacePoint> base_;
  std::vector<SurfacePlace> at_vertices_;
};

}  // namespace tvg
