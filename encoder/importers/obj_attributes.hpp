#pragma once
#include "encoder/importers/corner_values.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tvg::cli {

/// The texture coordinates, normals and colours of an OBJ file while it is read. Nothing of them makes a file
/// unreadable: what is wrong is left out with a note.
class ObjAttributes {
 public:
  explicit ObjAttributes(MeshFile& mesh) : mesh_(mesh) {}

  /// The rest of a line `vt` or `vn`.
  void read_texcoord(TextCursor& cursor) { texcoords_.read(cursor); }
  void read_normal(TextCursor& cursor) { normals_.read(cursor); }
  /// What follows the position of the last vertex.
  void read_behind_position(TextCursor& cursor);

  void begin_face() {
    texcoords_.corners.begin_face();
    normals_.corners.begin_face();
  }
  /// What follows the vertex of the `corner`th corner of a face, counted from 1: nothing, /T, //N or /T/N.
  void read_corner(TextCursor& cursor, std::uint32_t corner);

  /// Gives the mesh its attributes and notes.
  void finish();

 private:
  /// Values and who has them.
  struct Channel {
    Channel(const char* what_it_is, std::uint32_t stored_numbers)
        : what(what_it_is), stride(stored_numbers) {}

    void read(TextCursor& cursor);
    /// An index as faces have it, counted from 1 or back from the last, or 0 for none.
    void add_corner(std::uint32_t corner, std::int64_t index, std::size_t triangles, std::size_t line);

    const char* what;
    std::uint32_t stride;      // numbers of a value as they are kept
    std::uint32_t widest = 0;  // of a value in the file
    std::vector<float> values;
    CornerValues corners;
    std::uint32_t largest = 0;  // counted from 1
    std::size_t bad_line = 0;   // of the first index that names nothing
    std::size_t largest_line = 0;
  };

  void give(Channel& channel, AttributeKind kind);
  void give_colours();

  MeshFile& mesh_;
  Channel texcoords_{"texture coordinates", 3};
  Channel normals_{"normals", 3};
  std::vector<float> colours_;  // [vertex][rgba], as many as there are up to the last vertex that has one
  std::size_t coloured_ = 0;    // vertices
  bool alpha_ = false;
};

}  // namespace tvg::cli
