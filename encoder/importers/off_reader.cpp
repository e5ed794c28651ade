#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

class OffReader {
 public:
  OffReader(const std::string& file, std::string_view text, MeshFile& mesh)
      : file_(file), cursor_(file, text), mesh_(mesh) {}

  void read() {
    read_keyword();
    next_line("its header");
    const std::uint64_t vertices = read_count("vertices");
    const std::uint64_t faces = read_count("faces");
    if (faces == 0) throw ImportError(ErrorCode::kInvalidInput, fmt::format("{} has no faces", file_));
    cursor_.next_line();
    for (std::uint64_t vertex = 0; vertex < vertices; ++vertex) read_vertex(vertex, vertices);
    for (std::uint64_t face = 0; face < faces; ++face) read_face(face, faces);
    if (cursor_.next_content_line('#')) {
      cursor_.fail(fmt::format("the header promises {} vertices and {} faces, but more lines follow",
                               vertices, faces));
    }
  }

 private:
  /// Leaves the cursor behind the keyword: the counts may follow in the same line.
  void read_keyword() {
    const bool any = cursor_.next_content_line('#');
    const std::string_view keyword = any ? cursor_.word() : "";
    if (!keyword.ends_with("OFF"))
      cursor_.fail("an OFF file begins with the word OFF, COFF, NOFF or the like");
    const std::string_view prefix = keyword.substr(0, keyword.size() - 3);
    if (prefix.find_first_not_of("STCN") != prefix.npos) {
      cursor_.fail(fmt::format("'{}' is a variant that is not read: vertices must have three coordinates",
                               is_plain_text(keyword) ? keyword : "(binary)"));
    }
    TextCursor ahead = cursor_;
    if (ahead.word() == "BINARY") cursor_.fail("binary OFF files are not read; convert it to text or to PLY");
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
    for (int axis = 0; axis < 3; ++axis) {
      const float value = cursor_.number();
      if (!std::isfinite(value)) {
        cursor_.fail(fmt::format("vertex {} has a coordinate that is NaN or infinite", vertex));
      }
      mesh_.positions.push_back(value);
    }
    cursor_.next_line();
  }

  void read_face(std::uint64_t face, std::uint64_t count) {
    if (!cursor_.next_content_line('#')) {
      cursor_.fail_at_end(fmt::format("face {}; its header promises {} faces", face, count));
    }
    const std::int64_t corners = cursor_.integer();
    if (corners < 3)
      cursor_.fail(fmt::format("a face needs three corners or more, this one has {}", corners));
    FanBuilder fan(mesh_);
    fan.begin();
    for (std::int64_t corner = 0; corner < corners; ++corner) {
      const std::int64_t index = cursor_.integer();
      if (index < 0 || static_cast<std::uint64_t>(index) >= mesh_.vertex_count()) {
        cursor_.fail(fmt::format("the face uses vertex {}, but the file has vertices 0 to {}", index,
                                 static_cast<std::int64_t>(mesh_.vertex_count()) - 1));
      }
      fan.add(static_cast<std::uint32_t>(index));
    }
    static_cast<void>(fan.end());
    cursor_.next_line();
  }

  const std::string& file_;
  TextCursor cursor_;
  MeshFile& mesh_;
};

}  // namespace

void parse_off(const std::string& file, std::string_view bytes, MeshFile& mesh) {
  mesh.clear();
  require_whole_text(file, bytes);
  OffReader(file, bytes, mesh).read();
}

}  // namespace tvg::cli
