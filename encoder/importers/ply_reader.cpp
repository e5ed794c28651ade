#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/ply_header.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

/// The value as float32; infinite where it is too large.
float to_float(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (std::abs(value) > kLargest) return std::numeric_limits<float>::infinity();
  return static_cast<float>(value);
}

/// The values of an ASCII body: one line per element.
class TextValues {
 public:
  TextValues(const std::string& file, std::string_view bytes, const PlyHeader& header)
      : cursor_(file, bytes.substr(header.size), header.lines + 1) {}

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
  float real(PlyType) { return cursor_.number(); }
  std::int64_t integer(PlyType) { return cursor_.integer(); }
  void skip(PlyType, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      if (cursor_.word().empty()) cursor_.fail("fewer values than the header promises");
    }
  }
  void finish() {
    while (!cursor_.at_end()) {
      if (!cursor_.at_line_end()) cursor_.fail("more lines than the header promises");
      cursor_.next_line();
    }
  }
  [[noreturn]] void fail(const std::string& what) { cursor_.fail(what); }

 private:
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
  float real(PlyType type) {
    switch (type) {
      case PlyType::kFloat32:
        return take<float>();
      case PlyType::kFloat64:
        return to_float(take<double>());
      default:
        return static_cast<float>(integer(type));
    }
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
  void finish() {
    if (next_ == bytes_.size()) return;
    throw ImportError(
        ErrorCode::kInvalidInput,
        fmt::format("{} has {} bytes after byte {}, where the data that its header promises end", file_,
                    bytes_.size() - next_, next_));
  }
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

template <class Values>
class BodyReader {
 public:
  BodyReader(const PlyHeader& header, Values values, MeshFile& mesh)
      : header_(header), values_(std::move(values)), mesh_(mesh), fan_(mesh) {}

  void read(std::uint64_t vertex_count) {
    vertex_count_ = vertex_count;
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      const bool is_vertex = element.name == "vertex";
      const bool is_face = element.name == "face";
      const std::size_t list = indices_property(element);
      const std::size_t axes[3] = {element.find("x"), element.find("y"), element.find("z")};
      for (std::uint64_t index = 0; index < element.count; ++index) {
        values_.begin_element(element, index);
        if (is_vertex) {
          read_vertex(element, axes, index);
        } else {
          for (std::size_t p = 0; p < element.properties.size(); ++p) {
            if (is_face && p == list) {
              read_face(element.properties[p]);
            } else {
              skip(element.properties[p]);
            }
          }
        }
        values_.end_element();
      }
    }
    values_.finish();
  }

  static std::size_t indices_property(const PlyElement& element) {
    const std::size_t index = element.find("vertex_indices");
    return index < element.properties.size() ? index : element.find("vertex_index");
  }

 private:
  void read_vertex(const PlyElement& element, const std::size_t (&axes)[3], std::uint64_t index) {
    float position[3] = {};
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      std::size_t axis = 0;
      while (axis < 3 && axes[axis] != p) ++axis;
      if (axis == 3) {
        skip(property);
        continue;
      }
      position[axis] = values_.real(property.type);
      if (!std::isfinite(position[axis])) {
        values_.fail(fmt::format("vertex {} has a coordinate that is NaN or infinite", index));
      }
    }
    mesh_.positions.insert(mesh_.positions.end(), position, position + 3);
  }

  void read_face(const PlyProperty& property) {
    const std::int64_t corners = values_.integer(property.count_type);
    if (corners < 3)
      values_.fail(fmt::format("a face needs three corners or more, this one has {}", corners));
    fan_.begin();
    for (std::int64_t corner = 0; corner < corners; ++corner) {
      const std::int64_t index = values_.integer(property.type);
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_) {
        values_.fail(fmt::format("the face uses vertex {}, but there are vertices 0 to {}", index,
                                 static_cast<std::int64_t>(vertex_count_) - 1));
      }
      fan_.add(static_cast<std::uint32_t>(index));
    }
    static_cast<void>(fan_.end());
  }

  void skip(const PlyProperty& property) {
    std::int64_t count = 1;
    if (property.is_list) count = values_.integer(property.count_type);
    if (count < 0) values_.fail(fmt::format("the list '{}' has the length {}", property.name, count));
    values_.skip(property.type, static_cast<std::uint64_t>(count));
  }

  const PlyHeader& header_;
  Values values_;
  MeshFile& mesh_;
  FanBuilder fan_;
  std::uint64_t vertex_count_ = 0;
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

void check_face_element(const std::string& file, const PlyHeader& header) {
  const PlyElement* face = find_element(header, "face");
  if (face == nullptr || face->count == 0) {
    const bool strips = find_element(header, "tristrips") != nullptr;
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{} has no faces{}", file,
                                                            strips ? " (triangle strips are not read)" : ""));
  }
  const std::size_t list = BodyReader<TextValues>::indices_property(*face);
  if (list == face->properties.size() || !face->properties[list].is_list) {
    fail_in_header(file, face->line, "the element 'face' has no list 'vertex_indices'");
  }
  const PlyType type = face->properties[list].type;
  if (type == PlyType::kFloat32 || type == PlyType::kFloat64) {
    fail_in_header(file, face->line, "the indices of 'face' must be whole numbers");
  }
}

}  // namespace

void parse_ply(const std::string& file, std::string_view bytes, MeshFile& mesh) {
  mesh.clear();
  const PlyHeader header = parse_ply_header(file, bytes);
  check_vertex_element(file, header);
  check_face_element(file, header);
  const std::uint64_t vertices = find_element(header, "vertex")->count;
  if (header.encoding == PlyEncoding::kAscii) {
    require_whole_text(file, bytes);
    BodyReader(header, TextValues(file, bytes, header), mesh).read(vertices);
  } else {
    BodyReader(header, BinaryValues(file, bytes, header), mesh).read(vertices);
  }
}

}  // namespace tvg::cli
