#include "simplify/vertex_remover.hpp"

#include "simplify/flat_ring.hpp"

#include <utility>

namespace tvg {

VertexRemover::VertexRemover(const Mesh& mesh, std::span<const FramePositions> frames,
                             const SimplifyOptions& options)
    : mesh_(cut_mesh(mesh)),
      positions_(mesh.vertex_count, frames),
      folds_(positions_, options.largest_turn),
      intersections_(mesh_, frames, options.intersection_frames),
      parameterization_(mesh_) {}

void VertexRemover::begin_level() {
  intersections_.rebuild();
}

std::optional<std::vector<RingTriangle>> VertexRemover::filling(std::span<const PlanePoint> plane) {
  const auto allowed = [this](const std::vector<RingTriangle>& triangles) {
    return !triangles.empty() && !mesh_.repeats(ring_, triangles) && folds_.allows(triangles) &&
           intersections_.allows(ring_, triangles);
  };
  std::vector<RingTriangle> triangles = delaunay_of_polygon(plane);
  if (allowed(triangles)) return triangles;
  if (plane.size() == 3) return {};
  for (std::uint32_t apex = 0; apex < plane.size(); ++apex) {
    triangles = fan_of_polygon(plane, apex);
    if (allowed(triangles)) return triangles;
  }
  return {};
}

bool VertexRemover::remove(std::uint32_t vertex) {
  if (!mesh_.ring_of(vertex, ring_) || ring_.size() < 3) return false;
  folds_.begin(mesh_.origin(vertex), ring_);
  if (!ring_.closed && !folds_.allows_chord()) return false;
  std::vector<PlanePoint> plane = flatten_ring(folds_.angles(), folds_.radii(), ring_.closed);
  std::optional<std::vector<RingTriangle>> triangles = filling(plane);
  if (!triangles) return false;
  removals_.push_back({vertex, ring_.vertices, std::move(plane), ring_.faces, std::move(*triangles)});
  parameterization_.replace(removals_.back());
  mesh_.remove(ring_, removals_.back().triangles, filled_);
  intersections_.filled(filled_);
  return true;
}

}  // namespace tvg
