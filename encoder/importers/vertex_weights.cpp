#include "encoder/importers/vertex_weights.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"
#include "encoder/importers/text_cursor.hpp"
#include "tool/mesh_format.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace tvg::cli {

namespace {

constexpr std::string_view kNumpyMagic("\x93NUMPY", 6);
constexpr std::size_t kNumpyPreamble = 8;  // magic and version

[[noreturn]] void fail(const std::string& path, const std::string& what,
                       ErrorCode code = ErrorCode::kInvalidInput) {
  throw ImportError(code, fmt::format("{}: {}", path, what));
}

struct NumpyHeader {
  bool wide = false;  ///< float64, not float32
  std::uint64_t count = 0;
  std::size_t data_offset = 0;
};

/// What stands behind a key in the header's dictionary, a Python literal: of a text or a tuple what is
/// between its quotes or brackets. Empty where it is missing.
std::string_view header_value(std::string_view header, std::string_view key) {
  const auto at_quote = [&](std::size_t at) {
    return at < header.size() && (header[at] == '\'' || header[at] == '"');
  };
  for (std::size_t at = header.find(key); at != std::string_view::npos; at = header.find(key, at + 1)) {
    const std::size_t behind = at + key.size();
    if (at == 0 || !at_quote(at - 1) || !at_quote(behind)) continue;
    const std::size_t begin = header.find_first_not_of(": ", behind + 1);
    if (begin == std::string_view::npos) return {};
    std::string_view value = header.substr(begin);
    const char open = value.front();
    if (open == '(') return value.substr(1, value.find(')') - 1);
    if (open == '\'' || open == '"') return value.substr(1, value.find(open, 1) - 1);
    return value.substr(0, value.find_first_of(",} "));
  }
  return {};
}

NumpyHeader read_numpy_header(const std::string& path, const std::string& bytes) {
  const int version = static_cast<unsigned char>(bytes[6]);
  if (version < 1 || version > 3)
    fail(path, fmt::format("version {} of NumPy's format is not read", version));
  const std::size_t length_size = version == 1 ? 2 : 4;
  if (bytes.size() < kNumpyPreamble + length_size) fail(path, "ends in its header", ErrorCode::kTruncated);
  const char* at = bytes.data() + kNumpyPreamble;
  const std::size_t length = version == 1 ? load<std::uint16_t>(at, false) : load<std::uint32_t>(at, false);
  // NumPy itself refuses longer ones.
  constexpr std::size_t kLongestHeader = 10000;
  if (length > kLongestHeader) fail(path, fmt::format("its header claims {} bytes", length));
  const std::size_t begin = kNumpyPreamble + length_size;
  if (length > bytes.size() - begin) fail(path, "ends in its header", ErrorCode::kTruncated);

  const std::string_view header = std::string_view(bytes).substr(begin, length);
  const std::string_view type = header_value(header, "descr").substr(0, 8);
  const std::string_view fortran = header_value(header, "fortran_order");
  const std::string_view shape = header_value(header, "shape").substr(0, 40);
  if (type != "<f4" && type != "<f8") {
    fail(path, fmt::format("holds numbers of type '{}': save them as float32 or float64, little-endian",
                           is_plain_text(std::string(type)) ? type : "?"));
  }
  if (fortran != "False") fail(path, "is in Fortran's order: save it in C's order");
  NumpyHeader result{type == "<f8", 0, begin + length};
  const auto [end, error] = std::from_chars(shape.data(), shape.data() + shape.size(), result.count);
  if (error != std::errc() || std::string_view(end, shape.data() + shape.size()) != ",") {
    fail(path, fmt::format("has the shape ({}): weights are an array of one dimension", shape));
  }
  return result;
}

std::vector<double> read_numpy(const std::string& path, const std::string& bytes) {
  if (bytes.size() < kNumpyPreamble || !std::string_view(bytes).starts_with(kNumpyMagic)) {
    fail(path, "is no NumPy file: it does not begin with NumPy's signature");
  }
  const NumpyHeader header = read_numpy_header(path, bytes);
  const std::size_t size = header.wide ? 8 : 4;
  const std::size_t held = bytes.size() - header.data_offset;
  if (held % size != 0 || held / size != header.count) {
    fail(path, fmt::format("its header promises {} numbers, {} bytes follow", header.count, held),
         held / size < header.count ? ErrorCode::kTruncated : ErrorCode::kInvalidInput);
  }
  std::vector<double> weights;
  for (std::size_t at = header.data_offset; at < bytes.size(); at += size) {
    const char* data = bytes.data() + at;
    weights.push_back(header.wide ? load<double>(data, false) : double{load<float>(data, false)});
  }
  return weights;
}

std::vector<double> read_text(const std::string& path, const std::string& text) {
  std::vector<double> weights;
  TextCursor cursor(path, text);
  while (cursor.next_content_line('#')) {
    weights.push_back(double{cursor.number()});
    if (!cursor.at_line_end())
      cursor.fail("there is more than one number: each vertex has a line of its own");
    cursor.next_line();
  }
  return weights;
}

}  // namespace

std::vector<double> read_vertex_weights(const std::string& path) {
  std::string bytes;
  read_file(path, bytes);
  return parse_vertex_weights(path, bytes);
}

std::vector<double> parse_vertex_weights(const std::string& path, const std::string& bytes) {
  std::vector<double> weights = has_suffix(path, ".npy") ? read_numpy(path, bytes) : read_text(path, bytes);
  const auto bad =
      std::find_if_not(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); });
  if (bad != weights.end()) {
    fail(path, fmt::format("number {} is infinite or not a number", bad - weights.begin()));
  }
  return weights;
}

}  // namespace tvg::cli
