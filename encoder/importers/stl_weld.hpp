#pragma once
#include "encoder/importers/mesh_file.hpp"

#include <string>
#include <vector>

#include <tvg/geometry.hpp>

namespace tvg::cli {

/// How far apart corners may lie that are one vertex.
struct WeldTolerance {
  double value = 1e-6;
  bool of_diagonal = true;  ///< a share of the diagonal of the first frame's box, not a length
};

/// Which corners of a sequence of triangle soup (STL) are one vertex: those that lie in one place in every
/// frame. Triangles may stand in another order in each frame, where it can be told which is which.
class StlWeld {
 public:
  StlWeld() = default;
  /// `corners`: positions of the first frame, unwelded.
  StlWeld(const std::vector<float>& corners, const WeldTolerance& tolerance);

  /// Takes the next frame into account: vertices whose corners come apart in it are split. Returns why it is
  /// no frame of this mesh ("has 3 triangles where FILE has 4", where FILE is `first_file`); else empty.
  std::string refine(const MeshFile& frame, const std::string& first_file);
  /// Back to the first frame, with the weld as it is.
  void rewind() { before_ = first_; }
  /// Brings the corners of the next frame into the order of the first, and welds them. Returns as refine()
  /// does.
  std::string apply(MeshFile& frame, const std::string& first_file);

  const Weld& weld() const { return weld_; }
  /// Vertices of the first frame that come apart later.
  std::size_t split_vertices() const { return weld_.vertex_count() - first_weld_.vertex_count(); }
  /// Whether a frame had its triangles in another order.
  bool reordered() const { return reordered_; }

 private:
  std::string order(std::vector<float>& corners, const std::string& first_file);

  double tolerance_ = 0;
  std::vector<float> first_;   // corners of the first frame
  std::vector<float> before_;  // corners of the frame before, in the first one's order
  Weld first_weld_;            // of the first frame alone
  Weld weld_;
  bool reordered_ = false;
};

}  // namespace tvg::cli
