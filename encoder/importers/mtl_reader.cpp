#include "encoder/importers/mtl_reader.hpp"

#include "encoder/importers/part_table.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace tvg::cli {

namespace {

std::optional<float> read_number(TextCursor& cursor) {
  const float number = cursor.number_or_nan();
  if (!std::isfinite(number)) return std::nullopt;
  return number;
}

/// One number stands for three; `spectral` and `xyz` are no colours that glTF has.
std::optional<std::array<float, 3>> read_colour(TextCursor& cursor) {
  const std::optional<float> red = read_number(cursor);
  if (!red) return std::nullopt;
  const float green = read_number(cursor).value_or(*red);
  const float blue = read_number(cursor).value_or(*red);
  return std::array<float, 3>{*red, green, blue};
}

bool is_number(std::string_view word) {
  return !word.empty() &&
         (std::isdigit(static_cast<unsigned char>(word.back())) != 0 || word.back() == '.') &&
         word.find_first_not_of("+-.0123456789eE") == word.npos;
}

/// How many words follow an option at most, all of them numbers where there may be fewer.
struct TextureOption {
  std::string_view name;
  int words;
};
constexpr std::array<TextureOption, 13> kTextureOptions = {{{"-blendu", 1},
                                                            {"-blendv", 1},
                                                            {"-boost", 1},
                                                            {"-mm", 2},
                                                            {"-o", 3},
                                                            {"-s", 3},
                                                            {"-t", 3},
                                                            {"-texres", 1},
                                                            {"-clamp", 1},
                                                            {"-bm", 1},
                                                            {"-imfchan", 1},
                                                            {"-type", 1},
                                                            {"-cc", 1}}};

/// Options, then a file's name, which may have blanks in it.
MtlTexture read_texture(TextCursor& cursor, bool& latin) {
  MtlTexture texture;
  for (;;) {
    TextCursor ahead = cursor;
    const std::string_view word = ahead.word();
    const auto option = std::find_if(kTextureOptions.begin(), kTextureOptions.end(),
                                     [&](const TextureOption& known) { return known.name == word; });
    if (option == kTextureOptions.end()) break;
    for (int i = 0; i < option->words; ++i) {
      TextCursor value = ahead;
      const std::string_view text = value.word();
      if (option->words > 1 && !is_number(text)) break;
      if (option->name == "-clamp") texture.clamped = text == "on";
      ahead = value;
    }
    cursor = ahead;
  }
  texture.file = readable_name(cursor.rest_of_line(), latin);
  return texture;
}

void read_line(TextCursor cursor, MtlMaterial& material) {
  std::string keyword(cursor.word());
  for (char& c : keyword) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  bool latin = false;
  if (keyword == "kd") material.diffuse = read_colour(cursor);
  if (keyword == "ke") material.emissive = read_colour(cursor);
  if (keyword == "ns") material.shininess = read_number(cursor);
  if (keyword == "pr") material.roughness = read_number(cursor);
  if (keyword == "pm") material.metallic = read_number(cursor);
  if (keyword == "tr") {
    const std::optional<float> transparency = read_number(cursor);
    if (transparency && !material.opacity) material.opacity = 1 - *transparency;
  }
  if (keyword == "d") {
    TextCursor ahead = cursor;
    if (ahead.word() == "-halo") cursor = ahead;
    material.opacity = read_number(cursor);
  }
  if (keyword == "map_kd") material.diffuse_map = read_texture(cursor, latin);
  if (keyword == "map_ke") material.emissive_map = read_texture(cursor, latin);
  if (keyword == "map_d") material.opacity_map = read_texture(cursor, latin);
  if (keyword == "norm" || keyword == "map_kn") material.normal_map = read_texture(cursor, latin);
}

}  // namespace

std::vector<MtlMaterial> parse_mtl(const std::string& file, std::string_view bytes) {
  const std::string_view text = without_byte_order_mark(file, bytes);
  require_text(file, text);
  std::vector<MtlMaterial> materials;
  bool latin = false;
  TextCursor cursor(file, text);
  for (; cursor.next_content_line('#'); cursor.next_line()) {
    TextCursor words = cursor;
    if (words.word() == "newmtl") {
      materials.emplace_back().name = readable_name(words.rest_of_line(), latin);
      continue;
    }
    if (materials.empty()) continue;
    read_line(cursor, materials.back());
    TextCursor line = cursor;
    materials.back().lines.push_back(readable_name(line.rest_of_line(), latin));
  }
  return materials;
}

}  // namespace tvg::cli
