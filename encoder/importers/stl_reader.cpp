#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

constexpr std::size_t kHeaderSize = 84;  // 80 bytes of anything, then the number of triangles
constexpr std::size_t kTriangleSize = 50;
constexpr std::size_t kNormalSize = 12;
constexpr std::size_t kMaximumTriangles = 0xffffffffU / 3;  // so that 32 bits can name each corner

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

/// -0 is the same place as 0: positions are read with 0 added.
void add_face(MeshFile& mesh) {
  const auto corner = static_cast<std::uint32_t>(3 * mesh.faces.size());
  mesh.faces.push_back({corner, corner + 1, corner + 2});
}

std::uint64_t promised_triangles(std::string_view bytes) {
  return load<std::uint32_t>(bytes.data() + 80, false);
}

/// Binary files may begin with the word "solid" too: their size tells them apart, and in a cut one their
/// bytes.
bool is_ascii(std::string_view bytes) {
  if (bytes.size() >= kHeaderSize && bytes.size() == kHeaderSize + kTriangleSize * promised_triangles(bytes))
    return false;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != bytes.npos && same_word(bytes.substr(first, 5), "solid") &&
         bytes.substr(0, 512).find('\0') == bytes.npos;
}

class AsciiStlReader {
 public:
  AsciiStlReader(const std::string& file, std::string_view text, MeshFile& mesh)
      : cursor_(file, text), mesh_(mesh) {}

  void read() {
    while (next_word()) {
      expect("solid");
      cursor_.next_line();
      for (;;) {
        require_word();
        if (same_word(word_, "endsolid")) break;
        expect("facet");
        read_facet();
      }
      cursor_.next_line();
    }
  }

 private:
  bool next_word() {
    // The cursor stays in the last line where the text ends, for messages.
    while (cursor_.at_line_end() && !cursor_.at_end()) cursor_.next_line();
    word_ = cursor_.word();
    return !word_.empty();
  }

  void require_word() {
    if (!next_word()) cursor_.fail_at_end(place());
  }

  std::string place() const {
    return in_facet_ ? fmt::format("triangle {}", mesh_.faces.size())
                     : "a solid (the word endsolid is missing)";
  }

  void expect(std::string_view expected) {
    if (same_word(word_, expected)) return;
    const std::string found(word_.substr(0, 30));
    if (cursor_.at_end()) cursor_.fail_at_end(fmt::format("a word where '{}' should be", expected));
    cursor_.fail(
        fmt::format("'{}' stands where '{}' should be", is_plain_text(found) ? found : "(binary)", expected));
  }

  void read_facet() {
    in_facet_ = true;
    next("normal");
    for (int axis = 0; axis < 3; ++axis) require_word();
    next("outer");
    next("loop");
    for (int corner = 0; corner < 3; ++corner) {
      next("vertex");
      for (int axis = 0; axis < 3; ++axis) read_coordinate();
    }
    next("endloop");
    next("endfacet");
    in_facet_ = false;
    if (mesh_.faces.size() == kMaximumTriangles)
      cursor_.fail("32-bit indices cannot name the corners of more triangles");
    add_face(mesh_);
  }

  void next(std::string_view expected) {
    require_word();
    expect(expected);
  }

  void read_coordinate() {
    if (cursor_.at_line_end()) {
      if (cursor_.at_end()) cursor_.fail_at_end(place());
      cursor_.fail(fmt::format("{} has a corner with fewer than three coordinates", place()));
    }
    // A number that the end of the text cuts may have lost digits.
    TextCursor ahead = cursor_;
    static_cast<void>(ahead.word());
    if (ahead.at_end()) cursor_.fail_at_end(place());
    const std::size_t axis = mesh_.positions.size() % 3;
    const float value = mesh_.origin ? mesh_.relative(cursor_.wide_number(), axis) : cursor_.number();
    if (!std::isfinite(value))
      cursor_.fail(fmt::format("{} has a coordinate that is NaN or infinite", place()));
    mesh_.positions.push_back(value + 0.0F);
  }

  TextCursor cursor_;
  MeshFile& mesh_;
  std::string_view word_;
  bool in_facet_ = false;
};

/// The number of triangles in a binary file: what its header says, or where that was never filled in, what
/// its size has room for. What follows the last is noted.
std::uint64_t count_triangles(const std::string& file, std::string_view bytes, MeshFile& mesh) {
  if (bytes.size() < kHeaderSize) {
    throw ImportError(ErrorCode::kTruncated, fmt::format("{} ends at byte {} inside its header of {} bytes",
                                                         file, bytes.size(), kHeaderSize));
  }
  std::uint64_t triangles = promised_triangles(bytes);
  const std::uint64_t held = (bytes.size() - kHeaderSize) / kTriangleSize;
  if (held > 0 && (triangles == 0 || triangles == 0xffffffffU)) {
    mesh.notes.push_back(
        fmt::format("its header says {} triangles, which was never put right: {} follow", triangles, held));
    triangles = held;
  }
  const std::uint64_t promised = kHeaderSize + kTriangleSize * triangles;
  if (bytes.size() < promised) {
    throw ImportError(
        ErrorCode::kTruncated,
        fmt::format("{} ends at byte {} inside triangle {}; its header promises {} triangles = {} bytes",
                    file, bytes.size(), held, triangles, promised));
  }
  if (bytes.size() > promised && triangles > 0) {
    mesh.notes.push_back(
        fmt::format("{} bytes behind its {} triangles left out", bytes.size() - promised, triangles));
  }
  if (triangles > kMaximumTriangles) {
    throw ImportError(
        ErrorCode::kInvalidInput,
        fmt::format("{}: 32-bit indices cannot name the corners of {} triangles", file, triangles));
  }
  return triangles;
}

void read_binary(const std::string& file, std::string_view bytes, MeshFile& mesh) {
  const std::uint64_t triangles = count_triangles(file, bytes, mesh);
  mesh.positions.reserve(9 * triangles);
  mesh.faces.reserve(triangles);
  for (std::uint64_t triangle = 0; triangle < triangles; ++triangle) {
    const char* corner = bytes.data() + kHeaderSize + kTriangleSize * triangle + kNormalSize;
    for (std::size_t i = 0; i < 9; ++i) {
      const float value = load<float>(corner + 4 * i, false);
      mesh.positions.push_back((mesh.origin ? mesh.relative(double{value}, i % 3) : value) + 0.0F);
    }
    add_face(mesh);
  }
  const std::size_t bad = find_non_finite(mesh.positions);
  if (bad < mesh.positions.size()) {
    throw ImportError(ErrorCode::kInvalidInput,
                      fmt::format("{}: triangle {} has a coordinate that is NaN or infinite", file, bad / 9));
  }
}

}  // namespace

void parse_stl(const std::string& file, std::string_view bytes, MeshFile& mesh) {
  mesh.clear();
  const bool sized_right =
      bytes.size() >= kHeaderSize && bytes.size() == kHeaderSize + kTriangleSize * promised_triangles(bytes);
  const bool marked =
      bytes.starts_with("\xef\xbb\xbf") || bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff");
  if (marked && !sized_right) bytes = without_byte_order_mark(file, bytes);
  if (is_ascii(bytes)) {
    AsciiStlReader(file, bytes, mesh).read();
  } else {
    read_binary(file, bytes, mesh);
  }
  if (mesh.faces.empty()) throw EmptyInputError(fmt::format("{} has no triangles", file));
}

}  // namespace tvg::cli
