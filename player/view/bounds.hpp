#pragma once
#include <tvg/geometry.hpp>
#include <tvg/types.hpp>

namespace tvg::player {

/// Whether a mesh stands for a frame that shows nothing: one vertex and no faces (format-spec §4.3).
inline bool shows_nothing(const Mesh& mesh) {
  return mesh.vertex_count <= 1 && mesh.faces.empty();
}

/// The radius of the ball around what is shown: half the box's diagonal; 1 where all is one point or nothing,
/// so that it can be divided by.
double view_radius(const BoundingBox& bounds);

}  // namespace tvg::player
