#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/ply_attributes.hpp"
#include "encoder/importers/ply_header.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace tvg::cli {

namespace {

constexpr const char* kStrips = "tristrips";

/// The values of an ASCII body: one line per element.
class TextValues {
 public:
  TextValues(const std::string& file, std::string_view bytes, const PlyHeader& header)
      : file_(file), cursor_(file, bytes.substr(header.size), header.lines + 1) {
    cursor_.expect_whole_lines();
  }

  void begin_element(const PlyElement& element, std::uint64_t index) {
    while (cursor_.at_line_end()) {
      if (cursor_.at_end()) {
        cursor_.fail_at_end(fmt::format("{} {}; its header promises {}", element.name, index, element.count));
      }
      cursor_.next_line();
    }
  }
  void end_element() {
    if (!cursor_.at_line_end()) cursor_.fail("more values than the header promises");
    cursor_.next_line();
  }
  float coordinate(PlyType, std::size_t axis, MeshFile& mesh) {
    return mesh.origin ? mesh.relative(cursor_.wide_number(), axis) : cursor_.number();
  }
  std::int64_t integer(PlyType) { return cursor_.integer(); }
  double number(PlyType type) {
    if (cursor_.at_line_end()) cursor_.fail("fewer values than the header promises");
    return type == PlyType::kFloat32 ? double{cursor_.number_or_nan()} : cursor_.wide_number_or_nan();
  }
  void skip(PlyType, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (cursor_.word().empty()) cursor_.fail("fewer values than the header promises");
    }
  }
  /// Bytes behind what the header promises.
  std::uint64_t finish() {
    while (cursor_.at_line_end() && !cursor_.at_end()) cursor_.next_line();
    return cursor_.bytes_left();
  }
  std::string place() const { return fmt::format("{}, line {}", file_, cursor_.line()); }
  [[noreturn]] void fail(const std::string& what) { cursor_.fail(what); }

 private:
  const std::string& file_;
  TextCursor cursor_;
};

/// The values of a binary body.
class BinaryValues {
 public:
  BinaryValues(const std::string& file, std::string_view bytes, const PlyHeader& header)
      : file_(file),
        bytes_(bytes),
        next_(header.size),
        big_endian_(header.encoding == PlyEncoding::kBigEndian) {}

  void begin_element(const PlyElement& element, std::uint64_t index) {
    element_ = &element;
    index_ = index;
  }
  void end_element() {}
  float coordinate(PlyType type, std::size_t axis, MeshFile& mesh) {
    if (type == PlyType::kFloat32 && !mesh.origin) return take<float>();
    const double value = number(type);
    if (mesh.origin) return mesh.relative(value, axis);
    constexpr double kLargest = std::numeric_limits<float>::max();
    return std::abs(value) > kLargest ? std::numeric_limits<float>::infinity() : static_cast<float>(value);
  }
  double number(PlyType type) {
    return type == PlyType::kFloat32   ? double{take<float>()}
           : type == PlyType::kFloat64 ? take<double>()
                                       : static_cast<double>(integer(type));
  }
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return take<std::int8_t>();
      case PlyType::kUint8:
        return take<std::uint8_t>();
      case PlyType::kInt16:
        return take<std::int16_t>();
      case PlyType::kUint16:
        return take<std::uint16_t>();
      case PlyType::kInt32:
        return take<std::int32_t>();
      case PlyType::kUint32:
        return take<std::uint32_t>();
      default:
        fail("a whole number is stored as a floating-point number");
    }
  }
  void skip(PlyType type, std::uint64_t count) {
    const std::size_t size = ply_type_size(type);
    if (count > (bytes_.size() - next_) / size) fail_at_end();
    next_ += count * size;
  }
  std::uint64_t finish() const { return bytes_.size() - next_; }
  std::string place() const { return fmt::format("{}, byte {}", file_, next_); }
  [[noreturn]] void fail(const std::string& what) {
    throw ImportError(ErrorCode::kInvalidInput,
                      fmt::format("{}, byte {}, {} {}: {}", file_, next_, element_->name, index_, what));
  }

 private:
  template <class T>
  T take() {
    if (bytes_.size() - next_ < sizeof(T)) fail_at_end();
    const T value = load<T>(bytes_.data() + next_, big_endian_);
    next_ += sizeof(T);
    return value;
  }
  [[noreturn]] void fail_at_end() {
    throw ImportError(ErrorCode::kTruncated,
                      fmt::format("{} ends at byte {} inside {} {}; its header promises {}", file_,
                                  bytes_.size(), element_->name, index_, element_->count));
  }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t next_;
  bool big_endian_;
  const PlyElement* element_ = nullptr;
  std::uint64_t index_ = 0;
};

/// The list of an element that holds vertices; else the number of properties.
std::size_t indices_property(const PlyElement& element) {
  const std::size_t index = element.find("vertex_indices");
  return index < element.properties.size() ? index : element.find("vertex_index");
}

template <class Values>
class BodyReader {
 public:
  BodyReader(const PlyHeader& header, Values values, MeshFile& mesh)
      : header_(header), values_(std::move(values)), mesh_(mesh), builder_(mesh) {}

  void read(const std::string& file, std::uint64_t vertex_count) {
    vertex_count_ = vertex_count;
    for (const PlyElement& element : header_.elements) {
      if (!element.properties.empty()) read_element(element);
    }
    builder_.finish(file);
    finish_properties();
    if (const std::uint64_t trailing = values_.finish(); trailing > 0) {
      mesh_.notes.push_back(fmt::format("{} bytes behind what its header promises left out", trailing));
    }
  }

 private:
  void read_element(const PlyElement& element) {
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face") return read_faces(element);
    const std::size_t list = element.name == kStrips ? indices_property(element) : element.properties.size();
    for (std::uint64_t index = 0; index < element.count; ++index) {
      values_.begin_element(element, index);
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (p != list) {
          skip(element.properties[p]);
        } else {
          read_strips(element.properties[p]);
        }
      }
      values_.end_element();
    }
  }

  void read_vertices(const PlyElement& element) {
    const std::size_t axes[3] = {element.find("x"), element.find("y"), element.find("z")};
    if (!mesh_.positions_only) attributes_.emplace(element);
    for (std::uint64_t index = 0; index < element.count; ++index) {
      values_.begin_element(element, index);
      read_vertex(element, axes);
      values_.end_element();
    }
  }

  void read_vertex(const PlyElement& element, const std::size_t (&axes)[3]) {
    std::array<float, 3> position{};
    if (attributes_) attributes_->begin_vertex();
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      std::size_t axis = 0;
      while (axis < 3 && axes[axis] != p) ++axis;
      if (axis < 3) {
        position[axis] = values_.coordinate(property.type, axis, mesh_);
      } else if (attributes_ && attributes_->wants(p)) {
        attributes_->set(p, values_.number(property.type));
      } else {
        skip(property);
      }
    }
    builder_.add_vertex(position, [this] { return values_.place(); });
  }

  void read_faces(const PlyElement& element) {
    const std::size_t list = indices_property(element);
    const std::size_t none = element.properties.size();
    const auto find = [&](const char* name, bool is_list) {
      const std::size_t p = mesh_.positions_only ? none : element.find(name);
      return p < none && element.properties[p].is_list == is_list ? p : none;
    };
    const std::size_t texcoords = find("texcoord", true);
    const std::size_t texture = header_.textures.empty() ? none : find("texnumber", false);
    for (std::uint64_t index = 0; index < element.count; ++index) {
      values_.begin_element(element, index);
      const std::size_t triangle = mesh_.faces.size();
      list_.clear();
      for (std::size_t p = 0; p < none; ++p) {
        if (p == list) {
          read_face(element.properties[p]);
        } else if (p == texcoords) {
          read_list(element.properties[p]);
        } else if (p == texture) {
          texture_ = values_.number(element.properties[p].type);
        } else {
          skip(element.properties[p]);
        }
      }
      values_.end_element();
      if (texcoords < none) texcoords_.add_face(list_, builder_.corners(), triangle, mesh_);
      if (texture < none) add_texture_of_face();
    }
    for (std::size_t p = 0; p < none && !mesh_.positions_only; ++p) {
      const std::string& name = element.properties[p].name;
      if (p != list && p != texcoords && p != texture)
        left_out_.push_back(is_plain_text(name) ? name : "(binary)");
    }
  }

  void read_list(const PlyProperty& property) {
    const std::int64_t length = read_length(property);
    for (std::int64_t i = 0; i < length; ++i)
      list_.push_back(static_cast<float>(values_.number(property.type)));
  }

  /// A face whose number names no texture has the first.
  void add_texture_of_face() {
    const bool known = texture_ >= 0 && texture_ < static_cast<double>(header_.textures.size());
    mesh_.face_parts.resize(mesh_.faces.size(), known ? static_cast<std::uint32_t>(texture_) : 0);
  }

  void finish_properties() {
    if (mesh_.positions_only) return;
    if (attributes_) attributes_->finish(mesh_);
    texcoords_.finish(mesh_);
    if (!left_out_.empty())
      mesh_.notes.push_back(fmt::format("the face properties {} are left out", fmt::join(left_out_, ", ")));
    if (header_.textures.empty()) return;
    mesh_.texture_files = header_.textures;
    for (const std::string& texture : header_.textures) mesh_.parts.push_back({"", "", texture});
    mesh_.face_parts.resize(mesh_.faces.size(), 0);
  }

  std::int64_t read_length(const PlyProperty& property) {
    const std::int64_t count = values_.integer(property.count_type);
    if (count < 0) values_.fail(fmt::format("the list '{}' has the length {}", property.name, count));
    return count;
  }

  std::uint32_t checked(std::int64_t index) {
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_) {
      values_.fail(fmt::format("the face uses vertex {}, but there are vertices 0 to {}", index,
                               static_cast<std::int64_t>(vertex_count_) - 1));
    }
    return static_cast<std::uint32_t>(index);
  }

  void read_face(const PlyProperty& property) {
    const std::int64_t corners = read_length(property);
    builder_.begin_face();
    for (std::int64_t corner = 0; corner < corners; ++corner)
      builder_.add_corner(checked(values_.integer(property.type)));
    builder_.end_face();
  }

  /// Strips of triangles one behind the other, -1 after each: every second triangle of a strip has its first
  /// two corners swapped. Triangles with a corner twice only lead the strip on.
  void read_strips(const PlyProperty& property) {
    const std::int64_t length = read_length(property);
    std::array<std::uint32_t, 2> before{};
    std::uint64_t place = 0;
    for (std::int64_t i = 0; i < length; ++i) {
      const std::int64_t index = values_.integer(property.type);
      if (index == -1 || (property.type == PlyType::kUint32 && index == std::int64_t{0xffffffff})) {
        place = 0;
        continue;
      }
      const std::uint32_t vertex = checked(index);
      if (place >= 2 && vertex != before[0] && vertex != before[1] && before[0] != before[1]) {
        const bool odd = place % 2 == 1;
        mesh_.faces.push_back({before[odd ? 1 : 0], before[odd ? 0 : 1], vertex});
      }
      before = {before[1], vertex};
      ++place;
    }
  }

  void skip(const PlyProperty& property) {
    const std::int64_t count = property.is_list ? read_length(property) : 1;
    values_.skip(property.type, static_cast<std::uint64_t>(count));
  }

  const PlyHeader& header_;
  Values values_;
  MeshFile& mesh_;
  MeshBuilder builder_;
  std::uint64_t vertex_count_ = 0;
  std::optional<PlyAttributes> attributes_;
  PlyFaceTexcoords texcoords_;
  std::vector<float> list_;  // of the present face
  double texture_ = 0;       // of the present face
  std::vector<std::string> left_out_;
};

const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
  for (const PlyElement& element : header.elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

[[noreturn]] void fail_in_header(const std::string& file, std::size_t line, const std::string& what) {
  throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}, line {}: {}", file, line, what));
}

void check_vertex_element(const std::string& file, const PlyHeader& header) {
  const PlyElement* vertex = find_element(header, "vertex");
  if (vertex == nullptr) fail_in_header(file, header.lines, "the header has no element 'vertex'");
  for (const char* axis : {"x", "y", "z"}) {
    const std::size_t index = vertex->find(axis);
    if (index == vertex->properties.size() || vertex->properties[index].is_list) {
      fail_in_header(file, vertex->line,
                     fmt::format("the element 'vertex' has no property '{}' of one number", axis));
    }
  }
  if (vertex->count > std::numeric_limits<std::uint32_t>::max()) {
    fail_in_header(file, vertex->line, fmt::format("32-bit indices cannot name {} vertices", vertex->count));
  }
}

/// Whether an element of faces or strips is there and has anything; checks its list.
bool has_indices(const std::string& file, const PlyHeader& header, const char* name) {
  const PlyElement* element = find_element(header, name);
  if (element == nullptr || element->count == 0) return false;
  const std::size_t list = indices_property(*element);
  if (list == element->properties.size() || !element->properties[list].is_list) {
    fail_in_header(file, element->line, fmt::format("the element '{}' has no list 'vertex_indices'", name));
  }
  const PlyType type = element->properties[list].type;
  if (type == PlyType::kFloat32 || type == PlyType::kFloat64) {
    fail_in_header(file, element->line, fmt::format("the indices of '{}' must be whole numbers", name));
  }
  return true;
}

}  // namespace

void parse_ply(const std::string& file, std::string_view bytes, MeshFile& mesh) {
  mesh.clear();
  bytes = without_byte_order_mark(file, bytes);
  const PlyHeader header = parse_ply_header(file, bytes);
  check_vertex_element(file, header);
  const bool faces = has_indices(file, header, "face");
  const bool strips = has_indices(file, header, kStrips);
  if (!faces && !strips) throw EmptyInputError(fmt::format("{} has no faces", file));
  const std::uint64_t vertices = find_element(header, "vertex")->count;
  if (header.encoding == PlyEncoding::kAscii) {
    require_text(file, bytes);
    BodyReader(header, TextValues(file, bytes, header), mesh).read(file, vertices);
    if (std::string note = unended_line_note(bytes); !note.empty()) mesh.notes.push_back(std::move(note));
  } else {
    BodyReader(header, BinaryValues(file, bytes, header), mesh).read(file, vertices);
  }
}

}  // namespace tvg::cli
