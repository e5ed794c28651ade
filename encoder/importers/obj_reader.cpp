#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/obj_attributes.hpp"
#include "encoder/importers/part_table.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <array>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

constexpr std::uint64_t kMaximumVertices = std::numeric_limits<std::uint32_t>::max();

class ObjReader {
 public:
  ObjReader(const std::string& file, std::string_view text, MeshFile& mesh)
      : file_(file), cursor_(file, text), mesh_(mesh), builder_(mesh), attributes_(mesh) {
    cursor_.expect_whole_lines();
  }

  void read() {
    for (; !cursor_.at_end(); cursor_.next_line()) {
      const std::string_view keyword = cursor_.word();
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "f") {
        read_face();
      } else if (keyword == "o" || keyword == "g") {
        read_name(keyword == "o");
      } else if (!mesh_.positions_only) {
        read_property(keyword);
      }
    }
    if (largest_index_ > mesh_.vertex_count()) {
      throw ImportError(ErrorCode::kInvalidInput,
                        fmt::format("{}, line {}: the face uses vertex {}, but the file has {} vertices",
                                    file_, largest_index_line_, largest_index_, mesh_.vertex_count()));
    }
    builder_.finish(file_, " (lines that begin with 'f')");
    if (mesh_.positions_only) return;
    attributes_.finish();
    parts_.give_to(mesh_);
    if (parts_.had_latin_names()) mesh_.notes.push_back("names that are no UTF-8 are read as Latin-1");
  }

 private:
  void read_name(bool of_object) {
    const std::string_view name = cursor_.rest_of_line();
    if (mesh_.name.empty() && is_plain_text(name)) mesh_.name = name;
    if (of_object) {
      parts_.set_object(name);
    } else {
      parts_.set_group(name);
    }
  }

  void read_property(std::string_view keyword) {
    if (keyword == "vt") {
      attributes_.read_texcoord(cursor_);
    } else if (keyword == "vn") {
      attributes_.read_normal(cursor_);
    } else if (keyword == "usemtl") {
      parts_.set_material(cursor_.rest_of_line());
    } else if (keyword == "s") {
      const float group = cursor_.number_or_nan();  // NaN: off
      parts_.set_smoothing(group > 0 ? group : 0);
    } else if (keyword == "mtllib") {
      mesh_.material_files.emplace_back(cursor_.rest_of_line());
    }
  }

  void read_vertex() {
    if (mesh_.vertex_count() == kMaximumVertices) cursor_.fail("more vertices than 32-bit indices can name");
    std::array<float, 3> position{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cursor_.skip_blanks_and_continuations();
      position[axis] = mesh_.origin ? mesh_.relative(cursor_.wide_number(), axis) : cursor_.number();
    }
    builder_.add_vertex(position, [this] { return fmt::format("{}, line {}", file_, cursor_.line()); });
    if (!mesh_.positions_only) attributes_.read_behind_position(cursor_);
  }

  void read_face() {
    builder_.begin_face();
    attributes_.begin_face();
    parts_.begin_face(mesh_.faces.size());
    for (;;) {
      cursor_.skip_blanks_and_continuations();
      if (cursor_.at_line_end() || cursor_.peek() == '#') break;
      builder_.add_corner(read_corner());
    }
    if (builder_.corners() < 3 && cursor_.at_end()) {
      cursor_.fail(fmt::format("a face needs three corners, this one has {}", builder_.corners()));
    }
    builder_.end_face();
  }

  /// V, V/T, V//N or V/T/N; returns V counted from 0.
  std::uint32_t read_corner() {
    const std::int64_t index = cursor_.integer_prefix();
    if (!mesh_.positions_only) attributes_.read_corner(cursor_, builder_.corners() + 1);
    for (; !TextCursor::is_delimiter(cursor_.peek()); cursor_.advance()) {
      const char c = cursor_.peek();
      if (c != '/' && c != '-' && (c < '0' || c > '9')) {
        cursor_.fail("a corner of a face is V, V/T, V//N or V/T/N");
      }
    }
    const auto vertices = static_cast<std::int64_t>(mesh_.vertex_count());
    if (index < 0 && index >= -vertices) return static_cast<std::uint32_t>(vertices + index);
    if (index == 0) cursor_.fail("the face uses vertex 0, but OBJ counts vertices from 1");
    if (index < 0 || index > static_cast<std::int64_t>(kMaximumVertices)) {
      cursor_.fail(fmt::format("the face uses vertex {}, but {} vertices came before", index, vertices));
    }
    // A vertex may follow the faces that use it, so the check waits for the end of the file.
    if (static_cast<std::uint64_t>(index) > largest_index_) {
      largest_index_ = static_cast<std::uint64_t>(index);
      largest_index_line_ = cursor_.line();
    }
    return static_cast<std::uint32_t>(index - 1);
  }

  const std::string& file_;
  TextCursor cursor_;
  MeshFile& mesh_;
  MeshBuilder builder_;
  ObjAttributes attributes_;
  PartTable parts_;
  std::uint64_t largest_index_ = 0;  // counted from 1
  std::size_t largest_index_line_ = 0;
};

}  // namespace

void parse_obj(const std::string& file, std::string_view bytes, MeshFile& mesh) {
  mesh.clear();
  const std::string_view text = without_byte_order_mark(file, bytes);
  require_text(file, text);
  ObjReader(file, text, mesh).read();
  if (std::string note = unended_line_note(text); !note.empty()) mesh.notes.push_back(std::move(note));
}

}  // namespace tvg::cli
