#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/off_attributes.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

constexpr const char* kBinary = "binary OFF files are not read: convert it to text or to PLY";

class OffReader {
 public:
  OffReader(const std::string& file, std::string_view text, MeshFile& mesh)
      : file_(file), cursor_(file, text), mesh_(mesh), builder_(mesh) {
    cursor_.expect_whole_lines();
  }

  void read() {
    read_keyword();
    next_line("its header");
    const std::uint64_t vertices = read_count("vertices");
    const std::uint64_t faces = read_count("faces");
    if (faces == 0) throw EmptyInputError(fmt::format("{} has no faces", file_));
    cursor_.next_line();
    for (std::uint64_t vertex = 0; vertex < vertices; ++vertex) read_vertex(vertex, vertices);
    for (std::uint64_t face = 0; face < faces; ++face) read_face(face, faces);
    builder_.finish(file_);
    if (cursor_.next_content_line('#')) {
      mesh_.notes.push_back(
          fmt::format("{} bytes behind what its header promises left out", cursor_.bytes_left()));
    }
    if (mesh_.positions_only) return;
    attributes_.finish(mesh_);
    if (coloured_faces_ > 0)
      mesh_.notes.push_back(fmt::format("the colours of {} faces are left out", coloured_faces_));
  }

 private:
  /// Leaves the cursor behind the keyword: the counts may follow in the same line, without a blank too.
  void read_keyword() {
    const bool any = cursor_.next_content_line('#');
    TextCursor behind = cursor_;
    const std::string_view word = any ? behind.word() : "";
    const std::size_t end = word.find("OFF");
    if (end == word.npos || word.find_first_not_of("0123456789", end + 3) != word.npos)
      cursor_.fail("an OFF file begins with the word OFF, COFF, NOFF or the like");
    const std::string_view keyword = word.substr(0, end + 3);
    if (keyword.find_first_not_of("STCN") != end) {
      cursor_.fail(fmt::format("'{}' is a variant that is not read: vertices must have three coordinates",
                               is_plain_text(keyword) ? keyword : "(binary)"));
    }
    attributes_.set_columns(keyword.substr(0, end));
    if (behind.word() == "BINARY") cursor_.fail(kBinary);
    for (std::size_t i = 0; i < keyword.size(); ++i) cursor_.advance();
  }

  void next_line(const std::string& inside) {
    if (!cursor_.next_content_line('#')) cursor_.fail_at_end(inside);
  }

  std::uint64_t read_count(const char* what) {
    const std::int64_t count = cursor_.integer();
    if (count < 0 || count > std::numeric_limits<std::uint32_t>::max()) {
      cursor_.fail(fmt::format("the number of {} is {}", what, count));
    }
    return static_cast<std::uint64_t>(count);
  }

  void read_vertex(std::uint64_t vertex, std::uint64_t count) {
    if (!cursor_.next_content_line('#')) {
      cursor_.fail_at_end(fmt::format("vertex {}; its header promises {} vertices", vertex, count));
    }
    std::array<float, 3> position{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      position[axis] = mesh_.origin ? mesh_.relative(cursor_.wide_number(), axis) : cursor_.number();
    builder_.add_vertex(position, [this] { return fmt::format("{}, line {}", file_, cursor_.line()); });
    if (!mesh_.positions_only) attributes_.read_vertex(cursor_);
    cursor_.next_line();
  }

  void read_face(std::uint64_t face, std::uint64_t count) {
    if (!cursor_.next_content_line('#')) {
      cursor_.fail_at_end(fmt::format("face {}; its header promises {} faces", face, count));
    }
    const std::int64_t corners = cursor_.integer();
    if (corners < 0) cursor_.fail(fmt::format("a face has {} corners", corners));
    builder_.begin_face();
    for (std::int64_t corner = 0; corner < corners; ++corner) {
      const std::int64_t index = cursor_.integer();
      if (index < 0 || static_cast<std::uint64_t>(index) >= mesh_.vertex_count()) {
        cursor_.fail(fmt::format("the face uses vertex {}, but the file has vertices 0 to {}", index,
                                 static_cast<std::int64_t>(mesh_.vertex_count()) - 1));
      }
      builder_.add_corner(static_cast<std::uint32_t>(index));
    }
    builder_.end_face();
    if (!cursor_.at_line_end() && cursor_.peek() != '#') ++coloured_faces_;
    cursor_.next_line();
  }

  const std::string& file_;
  TextCursor cursor_;
  MeshFile& mesh_;
  MeshBuilder builder_;
  OffAttributes attributes_;
  std::uint64_t coloured_faces_ = 0;
};

}  // namespace

void parse_off(const std::string& file, std::string_view bytes, MeshFile& mesh) {
  mesh.clear();
  const std::string_view text = without_byte_order_mark(file, bytes);
  // Binary files have their keyword in text, and zero bytes behind it.
  const std::string_view first_line = text.substr(0, std::min(text.find_first_of("\r\n"), std::size_t{80}));
  if (first_line.find("OFF") != first_line.npos && first_line.find("BINARY") != first_line.npos)
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}, line 1: {}", file, kBinary));
  require_text(file, text);
  OffReader(file, text, mesh).read();
  if (std::string note = unended_line_note(text); !note.empty()) mesh.notes.push_back(std::move(note));
}

}  // namespace tvg::cli
