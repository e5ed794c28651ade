#pragma once
#include "tool/mesh_format.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/geometry.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// What a mesh file holds. Each index in `faces` is below vertex_count(), each coordinate is finite.
struct MeshFile {
  std::vector<float> positions;         ///< [vertex][xyz], in the file's order
  std::vector<Face> faces;              ///< [face][corner]; a polygon is a fan around its first corner
  std::string name;                     ///< of the first object (OBJ's o or g), or empty
  std::uint64_t polygons = 0;           ///< faces of the file with more than three corners
  std::uint64_t polygon_triangles = 0;  ///< triangles they became

  std::size_t vertex_count() const { return positions.size() / 3; }
  /// Empties it; capacities stay.
  void clear();
};

/// The readers. `bytes` is the whole file, `file` its name for messages; `mesh` is overwritten. Every error
/// is an ImportError: kTruncated where the file ends too early, kInvalidInput for all other content.
/// @{
void parse_obj(const std::string& file, std::string_view bytes, MeshFile& mesh);
/// ASCII and both binary byte orders, any properties and elements.
void parse_ply(const std::string& file, std::string_view bytes, MeshFile& mesh);
/// OFF with any of the prefixes ST, C, N; the columns they add are skipped.
void parse_off(const std::string& file, std::string_view bytes, MeshFile& mesh);
/// ASCII and binary. The result is not welded: vertex i is corner i, and face f is {3f, 3f + 1, 3f + 2}.
void parse_stl(const std::string& file, std::string_view bytes, MeshFile& mesh);
/// @}

/// Reads a mesh file through the reader of its format. `buffer` holds the file's bytes in the meantime; its
/// capacity is reused. STL is not welded.
void read_mesh_file(const std::string& path, MeshFormat format, std::string& buffer, MeshFile& mesh);

/// Replaces the corners of an unwelded mesh by the vertices of `weld`, which has as many points. Returns the
/// first corner that lies elsewhere than an earlier corner of the same vertex; nothing where there is none.
std::optional<std::size_t> apply_weld(const Weld& weld, MeshFile& mesh);

/// Builds the triangle fan of one polygon after another.
class FanBuilder {
 public:
  explicit FanBuilder(MeshFile& mesh) : mesh_(mesh) {}

  void begin() { corners_ = 0; }
  void add(std::uint32_t index) {
    ++corners_;
    if (corners_ == 1) first_ = index;
    if (corners_ > 2) mesh_.faces.push_back({first_, previous_, index});
    previous_ = index;
  }
  /// Returns false where the face had fewer than three corners.
  bool end() {
    if (corners_ > 3) {
      ++mesh_.polygons;
      mesh_.polygon_triangles += corners_ - 2;
    }
    return corners_ > 2;
  }
  std::uint64_t corners() const { return corners_; }

 private:
  MeshFile& mesh_;
  std::uint64_t corners_ = 0;
  std::uint32_t first_ = 0;
  std::uint32_t previous_ = 0;
};

}  // namespace tvg::cli
