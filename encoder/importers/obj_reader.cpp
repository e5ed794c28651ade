#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

constexpr std::uint64_t kMaximumVertices = std::numeric_limits<std::uint32_t>::max();

class ObjReader {
 public:
  ObjReader(const std::string& file, std::string_view text, MeshFile& mesh)
      : file_(file), cursor_(file, text), mesh_(mesh), fan_(mesh) {}

  void read() {
    for (; !cursor_.at_end(); cursor_.next_line()) {
      const std::string_view keyword = cursor_.word();
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "f") {
        read_face();
      } else if ((keyword == "o" || keyword == "g") && mesh_.name.empty()) {
        const std::string_view name = cursor_.rest_of_line();
        if (is_plain_text(name)) mesh_.name = name;
      }
    }
    if (mesh_.faces.empty()) {
      throw ImportError(ErrorCode::kInvalidInput,
                        fmt::format("{} has no faces (lines that begin with 'f')", file_));
    }
    if (largest_index_ > mesh_.vertex_count()) {
      throw ImportError(ErrorCode::kInvalidInput,
                        fmt::format("{}, line {}: the face uses vertex {}, but the file has {} vertices",
                                    file_, largest_index_line_, largest_index_, mesh_.vertex_count()));
    }
  }

 private:
  void read_vertex() {
    if (mesh_.vertex_count() == kMaximumVertices) cursor_.fail("more vertices than 32-bit indices can name");
    for (int axis = 0; axis < 3; ++axis) {
      cursor_.skip_blanks_and_continuations();
      const float value = cursor_.number();
      if (!std::isfinite(value)) {
        cursor_.fail(fmt::format("vertex {} has a coordinate that is NaN or infinite", mesh_.vertex_count()));
      }
      mesh_.positions.push_back(value);
    }
  }

  void read_face() {
    fan_.begin();
    for (;;) {
      cursor_.skip_blanks_and_continuations();
      if (cursor_.peek() == '\n' || cursor_.peek() == '#') break;
      fan_.add(read_corner());
    }
    if (!fan_.end())
      cursor_.fail(fmt::format("a face needs three corners or more, this one has {}", fan_.corners()));
  }

  /// V, V/T, V//N or V/T/N; returns V counted from 0.
  std::uint32_t read_corner() {
    const std::int64_t index = cursor_.integer_prefix();
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
  FanBuilder fan_;
  std::uint64_t largest_index_ = 0;  // counted from 1
  std::size_t largest_index_line_ = 0;
};

}  // namespace

void parse_obj(const std::string& file, std::string_view bytes, MeshFile& mesh) {
  mesh.clear();
  require_whole_text(file, bytes);
  ObjReader(file, bytes, mesh).read();
}

}  // namespace tvg::cli
