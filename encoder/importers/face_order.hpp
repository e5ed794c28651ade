#pragma once
#include "encoder/importers/mesh_file.hpp"

#include <span>
#include <string>
#include <vector>

#include <tvg/types.hpp>

namespace tvg::cli {

/// The faces of a mesh file, to tell whether another file has the same mesh: the same faces, whichever corner
/// each begins with and in whatever order they stand. A face that is turned inside out is another one.
class FaceOrder {
 public:
  FaceOrder() = default;
  /// `faces` and `polygons` as a MeshFile has them.
  FaceOrder(std::vector<Face> faces, std::vector<Polygon> polygons);

  /// What tells the faces of `other` from these: "has 3 triangles where FILE has 4", where FILE is `file`,
  /// the name of these; empty where they are the same.
  std::string difference(const MeshFile& other, const std::string& file) const;

 private:
  std::vector<Face> faces_;
  std::vector<Polygon> polygons_;
};

}  // namespace tvg::cli
