#include "encoder/importers/gltf_uri.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"
#include "tool/percent_decoded.hpp"

#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::uint8_t kNoDigit = 255;

constexpr std::array<std::uint8_t, 256> digits() {
  std::array<std::uint8_t, 256> values{};
  for (std::uint8_t& value : values) value = kNoDigit;
  std::uint8_t next = 0;
  for (const char c : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")) {
    values[static_cast<unsigned char>(c)] = next++;
  }
  // The alphabet that is safe in URIs.
  values['-'] = 62;
  values['_'] = 63;
  return values;
}

std::optional<std::string> decode_base64(std::string_view text) {
  static constexpr std::array<std::uint8_t, 256> kDigits = digits();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t pending = 0;
  int bits = 0;
  for (const char c : text) {
    const std::uint8_t digit = kDigits[static_cast<unsigned char>(c)];
    if (digit == kNoDigit) return std::nullopt;
    pending = (pending << 6 | digit) & 0xffff;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(pending >> bits & 0xff);
  }
  return bytes;
}

/// Whether a URI begins with a scheme, as "http:" is; a drive's letter is one too.
bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  for (const char c : uri.substr(0, colon)) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '+' && c != '-' && c != '.') return false;
  }
  return true;
}

bool stays_below(const fs::path& relative) {
  return !relative.empty() && relative.is_relative() && *relative.lexically_normal().begin() != "..";
}

}  // namespace

std::optional<std::string> decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string_view head = uri.substr(0, comma);
  const std::string_view body = uri.substr(comma + 1);
  if (!head.ends_with(";base64")) return percent_decoded(body);
  return body.find('%') == std::string_view::npos ? decode_base64(body)
                                                  : decode_base64(percent_decoded(body));
}

std::string read_beside(const std::string& scene, const std::string& uri) {
  const auto fail = [&](const std::string& what) {
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: its buffer \"{}\" {}", scene, uri, what));
  };
  if (has_scheme(uri)) fail("is not a file beside it: nothing is fetched; put the file there and name it so");
  fs::path relative = percent_decoded(uri);
  const fs::path folder = fs::path(scene).parent_path();
  std::error_code ignored;
  // Some exporters forget to encode what they write.
  if (!fs::exists(folder / relative, ignored)) relative = uri;
  if (!stays_below(relative) || relative.string().find('\0') != std::string::npos) {
    fail("is outside of its folder, where nothing is opened: put it into the folder");
  }
  const std::string path = (folder / relative).string();
  require_regular_file(path);
  if (!fs::exists(path, ignored)) fail("is missing: it goes beside the file");
  std::string bytes;
  read_file(path, bytes);
  return bytes;
}

}  // namespace tvg::cli
