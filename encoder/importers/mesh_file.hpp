#pragma once
#include "encoder/importers/import_error.hpp"
#include "tool/mesh_format.hpp"
#include "tool/origin.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/geometry.hpp>
#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// What a mesh file holds. Each index in `faces` is below vertex_count(), each coordinate is finite.
struct MeshFile {
  std::vector<float> positions;       ///< [vertex][xyz], in the file's order
  std::vector<Face> faces;            ///< [face][corner]; a polygon is a fan around its first corner
  std::vector<Polygon> polygons;      ///< faces of the file with more than three corners, in their order
  std::string name;                   ///< of the first object (OBJ's o or g), or empty
  std::vector<Attribute> attributes;  ///< none is animated; `bits` is kBitsOfKind
  std::vector<Part> parts;
  std::vector<std::uint32_t> face_parts;    ///< [face], its part; empty where there are no parts
  std::vector<std::string> material_files;  ///< OBJ's mtllib, as the file names them
  /// Of PLY: files of textures; each is a material of its own, with the same name.
  std::vector<std::string> texture_files;
  std::vector<std::uint32_t>
      misplaced;                   ///< vertices without a place (NaN), which no face uses: they are at 0
  std::vector<std::string> notes;  ///< what was left out or put right: "1 face with ... left out"
  /// Where it is set, before the file is read, coordinates are read in double and relative to it.
  std::optional<Origin> origin;
  bool positions_only = false;    ///< set before the file is read: no attributes, parts and materials
  bool finer_than_float = false;  ///< with an origin: the file has a coordinate that float32 cannot hold

  std::size_t vertex_count() const { return positions.size() / 3; }
  /// Empties it; capacities, the origin and positions_only stay.
  void clear();
  /// A coordinate as the positions have it, relative to the origin, which is set.
  float relative(double coordinate, std::size_t axis);
};

/// The readers. `bytes` is the whole file, `file` its name for messages; `mesh` is overwritten. Every error
/// is an ImportError: kTruncated where the file ends too early, kInvalidInput for all other content, an
/// EmptyInputError where there are no faces.
/// @{
void parse_obj(const std::string& file, std::string_view bytes, MeshFile& mesh);
/// ASCII and both binary byte orders, any properties and elements.
void parse_ply(const std::string& file, std::string_view bytes, MeshFile& mesh);
/// OFF with any of the prefixes ST, C, N and the columns they add.
void parse_off(const std::string& file, std::string_view bytes, MeshFile& mesh);
/// ASCII and binary. The result is not welded: vertex i is corner i, and face f is {3f, 3f + 1, 3f + 2}.
void parse_stl(const std::string& file, std::string_view bytes, MeshFile& mesh);
/// @}

/// Reads a mesh file through the reader of its format. `buffer` holds the file's bytes in the meantime; its
/// capacity is reused. STL is not welded.
void read_mesh_file(const std::string& path, MeshFormat format, std::string& buffer, MeshFile& mesh);

/// Reads a mesh file as read_mesh_file() does; where its coordinates are so far from 0 that steps of float32
/// are larger than a thousandth of the mesh, and the file has them finer, they are read relative to an origin
/// near the mesh, which `mesh.origin` then has. Where it is set before, it holds and (0, 0, 0) means: as they
/// are.
void read_located_mesh(const std::string& path, MeshFormat format, std::string& buffer, MeshFile& mesh);

/// Replaces the corners of an unwelded mesh by the vertices of `weld`, which has as many points: each is
/// where its first corner is.
void apply_weld(const Weld& weld, MeshFile& mesh);

/// What a reader makes a mesh with, face by face and vertex by vertex.
class MeshBuilder {
 public:
  explicit MeshBuilder(MeshFile& mesh) : mesh_(mesh) {}

  /// The triangle fan of one polygon after another.
  /// @{
  void begin_face() { corners_ = 0; }
  void add_corner(std::uint32_t index) {
    ++corners_;
    if (corners_ == 1) first_ = index;
    if (corners_ > 2) mesh_.faces.push_back({first_, previous_, index});
    previous_ = index;
  }
  /// A face of fewer than three corners is left out and counted.
  void end_face() {
    if (corners_ < 3) ++short_faces_;
    if (corners_ > 3) mesh_.polygons.push_back({mesh_.faces.size() - (corners_ - 2), corners_});
  }
  std::uint32_t corners() const { return corners_; }
  /// @}

  /// Adds a vertex. One with a coordinate that is no finite number is remembered with its place in the file
  /// ("a.obj, line 7"), which `place()` tells.
  template <class Place>
  void add_vertex(const std::array<float, 3>& position, Place&& place) {
    if (!std::isfinite(position[0]) || !std::isfinite(position[1]) || !std::isfinite(position[2])) {
      if (mesh_.misplaced.empty()) first_bad_place_ = place();
      mesh_.misplaced.push_back(static_cast<std::uint32_t>(mesh_.vertex_count()));
    }
    mesh_.positions.insert(mesh_.positions.end(), position.begin(), position.end());
  }

  /// What readers do at the end: notes on what was left out; vertices without a place go to 0. Throws
  /// ImportError where a face uses one of them, EmptyInputError "FILE has no faces" with `hint` where there
  /// is none.
  void finish(const std::string& file, const std::string& hint = "");

 private:
  MeshFile& mesh_;
  std::uint32_t corners_ = 0;
  std::uint32_t first_ = 0;
  std::uint32_t previous_ = 0;
  std::uint64_t short_faces_ = 0;
  std::string first_bad_place_;
};

}  // namespace tvg::cli
