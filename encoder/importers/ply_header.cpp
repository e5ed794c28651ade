#include "encoder/importers/ply_header.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <array>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <unordered_set>
#include <utility>

namespace tvg::cli {

namespace {

std::optional<PlyType> type_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
      {"char", PlyType::kInt8},
      {"int8", PlyType::kInt8},
      {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},
      {"short", PlyType::kInt16},
      {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16},
      {"uint16", PlyType::kUint16},
      {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},
      {"uint", PlyType::kUint32},
      {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat32},
      {"float32", PlyType::kFloat32},
      {"double", PlyType::kFloat64},
      {"float64", PlyType::kFloat64},
  }};
  for (const auto& [known, type] : kTypes) {
    if (known == name) return type;
  }
  return std::nullopt;
}

std::string shown(std::string_view word) {
  return is_plain_text(word) ? std::string(word.substr(0, 40)) : "(binary)";
}

// Far more than programs write; each value of a body costs a look at its property.
constexpr std::size_t kMostElements = 256;
constexpr std::size_t kMostProperties = 4096;
constexpr std::size_t kMostTextures = 256;

class HeaderReader {
 public:
  HeaderReader(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  PlyHeader read() {
    if (next_line() != "ply") fail("a PLY file begins with the word ply");
    bool has_format = false;
    for (;;) {
      TextCursor words(file_, next_line(), header_.lines);
      const std::string_view keyword = words.word();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        read_format(words);
        has_format = true;
      } else if (keyword == "element") {
        read_element(words);
      } else if (keyword == "property") {
        read_property(words);
      } else if (keyword == "comment") {
        read_comment(words);
      } else if (keyword != "obj_info" && !keyword.empty()) {
        fail(fmt::format("'{}' is not a word of a PLY header", shown(keyword)));
      }
    }
    if (!has_format) fail("the header has no line 'format ...'");
    return header_;
  }

 private:
  /// A line without its end and the blanks before it. Where the first line ends with CR alone, all do: what
  /// follows the header's last may be binary.
  std::string_view next_line() {
    if (header_.lines == 0) {
      const std::size_t first = bytes_.find_first_of("\r\n");
      if (first != bytes_.npos && bytes_[first] == '\r' && bytes_.substr(first + 1, 1) != "\n")
        line_end_ = '\r';
    }
    const std::size_t end = bytes_.find(line_end_, header_.size);
    if (end == bytes_.npos) {
      throw ImportError(ErrorCode::kTruncated, fmt::format("{} ends at byte {} inside line {} of its header",
                                                           file_, bytes_.size(), header_.lines + 1));
    }
    std::string_view line = bytes_.substr(header_.size, end - header_.size);
    while (!line.empty() && (line.back() == '\r' || TextCursor::is_blank(line.back()))) line.remove_suffix(1);
    header_.size = end + 1;
    ++header_.lines;
    return line;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}, line {}: {}", file_, header_.lines, what));
  }

  void read_format(TextCursor& words) {
    const std::string_view encoding = words.word();
    if (encoding == "ascii") {
      header_.encoding = PlyEncoding::kAscii;
    } else if (encoding == "binary_little_endian") {
      header_.encoding = PlyEncoding::kLittleEndian;
    } else if (encoding == "binary_big_endian") {
      header_.encoding = PlyEncoding::kBigEndian;
    } else {
      fail(fmt::format("'{}' is not ascii, binary_little_endian or binary_big_endian", shown(encoding)));
    }
    const std::string_view version = words.word();
    if (version != "1.0") fail(fmt::format("the version is '{}', but only 1.0 is known", shown(version)));
  }

  /// A program says there what the file's textures are.
  void read_comment(TextCursor& words) {
    if (words.word() != "TextureFile") return;
    const std::string_view name = words.rest_of_line();
    if (!name.empty() && is_plain_text(name) && header_.textures.size() < kMostTextures)
      header_.textures.emplace_back(name);
  }

  void read_element(TextCursor& words) {
    if (header_.elements.size() == kMostElements) fail(fmt::format("more than {} elements", kMostElements));
    PlyElement element;
    element.line = header_.lines;
    element.name = words.word();
    const std::string_view count = words.word();
    const auto [after, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc{} || after != count.data() + count.size()) {
      fail(fmt::format("'{}' stands where the number of elements should be", shown(count)));
    }
    for (const PlyElement& other : header_.elements) {
      if (other.name == element.name) fail(fmt::format("a second element '{}'", shown(element.name)));
    }
    header_.elements.push_back(std::move(element));
    names_.clear();
  }

  void read_property(TextCursor& words) {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    std::string_view type = words.word();
    if (type == "list") {
      property.is_list = true;
      property.count_type = read_type(words.word());
      if (property.count_type == PlyType::kFloat32 || property.count_type == PlyType::kFloat64) {
        fail("the length of a list must be a whole number");
      }
      type = words.word();
    }
    property.type = read_type(type);
    property.name = words.word();
    PlyElement& element = header_.elements.back();
    if (property.name.empty()) fail("a property without a name");
    if (!names_.insert(property.name).second) {
      fail(fmt::format("a second property '{}'", shown(property.name)));
    }
    if (++properties_ > kMostProperties) fail(fmt::format("more than {} properties", kMostProperties));
    element.properties.push_back(std::move(property));
  }

  PlyType read_type(std::string_view name) {
    const std::optional<PlyType> type = type_named(name);
    if (!type) fail(fmt::format("'{}' is not a PLY type", shown(name)));
    return *type;
  }

  const std::string& file_;
  std::string_view bytes_;
  char line_end_ = '\n';
  PlyHeader header_;
  std::unordered_set<std::string> names_;  // of the properties of the present element
  std::size_t properties_ = 0;             // of all elements
};

}  // namespace

std::size_t ply_type_size(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    case PlyType::kFloat64:
      return 8;
  }
  return 8;
}

std::size_t PlyElement::find(std::string_view property) const {
  std::size_t index = 0;
  while (index < properties.size() && properties[index].name != property) ++index;
  return index;
}

PlyHeader parse_ply_header(const std::string& file, std::string_view bytes) {
  return HeaderReader(file, bytes).read();
}

}  // namespace tvg::cli
