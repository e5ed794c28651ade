#include "decoder/exporters/material_data.hpp"

#include <algorithm>

namespace tvg::cli {

using nlohmann::json;

namespace {

/// Copying and writing JSON goes as deep as it is nested.
constexpr int kMostNested = 64;

bool is_nested_too_deep(std::span<const std::uint8_t> bytes) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = static_cast<char>(bytes[i]);
    if (in_text) {
      if (c == '\\') ++i;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMostNested) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

}  // namespace

std::optional<json> parse_json(std::span<const std::uint8_t> bytes) {
  if (is_nested_too_deep(bytes)) return std::nullopt;
  json parsed = json::parse(bytes.begin(), bytes.end(), nullptr, false);
  if (parsed.is_discarded()) return std::nullopt;
  return parsed;
}

const json& member(const json& value, const char* name) {
  static const json null_value;
  if (!value.is_object()) return null_value;
  const auto found = value.find(name);
  return found == value.end() ? null_value : *found;
}

const json& array_of(const json& value, const char* name) {
  static const json empty_array = json::array();
  const json& array = member(value, name);
  return array.is_array() ? array : empty_array;
}

std::string text_of(const json& value, const char* name) {
  const json& text = member(value, name);
  return text.is_string() ? text.get<std::string>() : std::string();
}

std::optional<std::size_t> index_of(const json& value, const char* name) {
  const json& number = member(value, name);
  if (!number.is_number_unsigned()) return std::nullopt;
  return number.get<std::size_t>();
}

std::vector<double> numbers_of(const json& value, const char* name, std::size_t count, double otherwise) {
  const json& array = member(value, name);
  std::vector<double> numbers(count, otherwise);
  if (!array.is_array() || array.size() < count) return numbers;
  for (std::size_t i = 0; i < count; ++i) {
    if (array[i].is_number()) numbers[i] = array[i].get<double>();
  }
  return numbers;
}

std::string image_type(std::span<const std::uint8_t> bytes) {
  const auto begins = [&bytes](std::string_view text, std::size_t at = 0) {
    return bytes.size() >= at + text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
  };
  if (begins("\x89PNG")) return "image/png";
  if (begins("\xFF\xD8\xFF")) return "image/jpeg";
  if (begins("RIFF") && begins("WEBP", 8)) return "image/webp";
  if (begins("\xABKTX 20")) return "image/ktx2";
  return "";
}

void MaterialData::add(const NamedData& data) {
  if (data.name == "materials") {
    auto parsed = parse_json(data.bytes);
    unreadable_ = !parsed || !parsed->is_object();
    if (!unreadable_) json_ = std::move(*parsed);
  } else if (data.name.starts_with("image/")) {
    images_[data.name] = data.bytes;
  }
}

const std::vector<std::uint8_t>* MaterialData::image(const std::string& name) const {
  const auto found = images_.find(name);
  return found == images_.end() ? nullptr : &found->second;
}

}  // namespace tvg::cli
