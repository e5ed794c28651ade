#pragma once
#include "simplify/fold_check.hpp"
#include "simplify/half_edge_mesh.hpp"
#include "simplify/intersection_check.hpp"
#include "simplify/moving_positions.hpp"
#include "simplify/parameterization.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tvg/simplify.hpp>

namespace tvg {

/// A mesh that loses one vertex after the other, as long as the hole can be filled without harm in any frame.
class VertexRemover {
 public:
  /// The frames must outlive it.
  VertexRemover(const Mesh& mesh, std::span<const FramePositions> frames, const SimplifyOptions& options);
  VertexRemover(const VertexRemover&) = delete;
  VertexRemover& operator=(const VertexRemover&) = delete;

  const HalfEdgeMesh& mesh() const { return mesh_; }
  const Parameterization& parameterization() const { return parameterization_; }
  /// In the order they happened.
  const std::vector<Removal>& removals() const { return removals_; }
  std::vector<Removal> take_removals() { return std::move(removals_); }

  /// Removes a vertex that is removable. False, and no change, where its hole cannot be filled.
  bool remove(std::uint32_t vertex);
  /// [place] What was around the vertex removed last.
  std::span<const std::uint32_t> last_ring() const { return ring_.vertices; }
  /// To be called before each level: what is near is found by the size of faces.
  void begin_level();
  /// Lets creases become sharper than they were from now on, but lets nothing fold.
  void allow_creases() { folds_.allow_creases(); }

 private:
  std::optional<std::vector<RingTriangle>> filling(std::span<const PlanePoint> plane);

  HalfEdgeMesh mesh_;
  MovingPositions positions_;
  FoldCheck folds_;
  IntersectionCheck intersections_;
  Parameterization parameterization_;
  std::vector<Removal> removals_;
  Ring ring_;
  std::vector<std::uint32_t> filled_;
};

}  // namespace tvg
