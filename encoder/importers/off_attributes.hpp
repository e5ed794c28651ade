#pragma once
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace tvg::cli {

/// The columns of an OFF file behind the positions, while its vertices are read: normals, colours and texture
/// coordinates, in this order, as its keyword says (NOFF, COFF, STOFF and together). A file without a letter
/// for colours may have them all the same.
class OffAttributes {
 public:
  /// `letters`: the keyword without OFF.
  void set_columns(std::string_view letters);
  /// The rest of a vertex's line.
  void read_vertex(TextCursor& cursor);
  /// Gives the mesh its attributes and notes.
  void finish(MeshFile& mesh);

 private:
  Attribute columns(AttributeKind kind, std::uint32_t first, std::uint32_t count) const;

  bool normals_ = false;
  bool texcoords_ = false;
  std::vector<float> numbers_;  // [vertex][width_]
  std::uint32_t width_ = 0;     // columns of the first vertex
  bool even_ = true;            // all vertices have as many
  bool any_ = false;            // a vertex was read
};

}  // namespace tvg::cli
