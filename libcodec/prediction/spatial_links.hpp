#pragma once
#include "prediction/surface_graph.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace tvg {

/// Pairs of vertices to link beside the edges of a mesh, so that one graph holds all of it: neighbours in the
/// order of a space-filling curve that stand at one point of the shape, or belong to different components
/// (format-spec §5.4.1).
class SpatialLinks {
 public:
  /// False without memory.
  [[nodiscard]] bool find(std::span<const Face> faces, std::span<const ShapePoint> shape);

  /// Calls take(a, b, whether at one point) for each pair.
  template <class Take>
  void for_each(std::span<const ShapePoint> shape, Take&& take) const {
    for (std::size_t i = 1; i < curve_.size(); ++i) {
      const std::uint32_t a = curve_[i - 1], b = curve_[i];
      const bool at_one_point = shape[a] == shape[b];
      if (at_one_point || root_[a] != root_[b]) take(a, b, at_one_point);
    }
  }

 private:
  std::uint32_t root_of(std::uint32_t v);

  std::vector<std::uint32_t> curve_;  ///< the vertices along the curve
  std::vector<std::uint32_t> root_;   ///< [vertex] one vertex of its component
};

}  // namespace tvg
