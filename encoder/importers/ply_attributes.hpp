#pragma once
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/ply_header.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tvg::cli {

/// The attributes that the properties of a PLY file's vertices make, while they are read: those of the usual
/// names are texture coordinates, normals and colours, and every other number is one of its own name.
class PlyAttributes {
 public:
  /// `vertex`: the header's element.
  explicit PlyAttributes(const PlyElement& vertex);

  /// Whether a property of the vertices belongs to an attribute.
  bool wants(std::size_t property) const { return columns_[property].attribute != kNone; }
  void begin_vertex();
  /// The value of a property of the vertex that was begun last.
  void set(std::size_t property, double value);
  /// Gives the mesh its attributes and notes on them.
  void finish(MeshFile& mesh);

 private:
  static constexpr std::size_t kNone = SIZE_MAX;
  struct Column {
    std::size_t attribute = kNone;
    std::size_t component = 0;
    double largest = 1;  // of its type where it is a whole number that means 1
  };

  bool take_group(const PlyElement& vertex, AttributeKind kind, const std::vector<const char*>& names);

  std::vector<Column> columns_;  // [property]
  std::vector<Attribute> attributes_;
  std::vector<std::uint64_t> rounded_;  // [attribute], how many values float32 does not hold
  std::vector<std::string> left_out_;
};

/// The texture coordinates that faces of a PLY file have for their corners (the list `texcoord`).
class PlyFaceTexcoords {
 public:
  /// A face whose list was read: `corners` of them, of which the mesh has all triangles from `triangle` on.
  void add_face(const std::vector<float>& list, std::uint32_t corners, std::size_t triangle, MeshFile& mesh);
  void finish(MeshFile& mesh);

 private:
  std::vector<float> values_;
  std::vector<std::uint32_t> corners_;
  std::uint64_t odd_lists_ = 0;
};

}  // namespace tvg::cli
