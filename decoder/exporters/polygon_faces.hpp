#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// A corner of a face as attributes count them: 3 * triangle + corner.
using CornerIndex = std::size_t;

/// The faces of a mesh as they were before polygons became fans of triangles. Triangles that are no fan, as
/// properties say they are, stay triangles.
class PolygonFaces {
 public:
  PolygonFaces(const Mesh& mesh, const MeshProperties& properties);

  std::size_t size() const { return first_corner_.size() - 1; }
  /// The corners of a face in order.
  std::span<const CornerIndex> operator[](std::size_t face) const {
    return std::span(corners_).subspan(first_corner_[face], first_corner_[face + 1] - first_corner_[face]);
  }
  /// The largest number of corners of a face; 3 where there are none.
  std::size_t most_corners() const { return most_corners_; }

 private:
  void add_triangle(std::size_t triangle);
  void add_fan(const Polygon& polygon);

  std::vector<CornerIndex> corners_;
  std::vector<std::size_t> first_corner_ = {0};
  std::size_t most_corners_ = 3;
};

}  // namespace tvg::cli
