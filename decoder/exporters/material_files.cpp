#include "decoder/exporters/material_files.hpp"

#include "decoder/exporters/mesh_writers.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace tvg::cli {

using nlohmann::json;

namespace {

/// The last part of a name with folders, of either system's kind.
std::string last_part(const std::string& name) {
  return name.substr(name.find_last_of("/\\") + 1);
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

/// The suffix for an image's file: the one that it has, where that is an image's and what it is. "" for what
/// is no image.
std::string image_suffix(const std::string& suffix, const std::string& type) {
  static const std::set<std::string> others = {".bmp", ".dds", ".exr", ".gif", ".hdr", ".pcx", ".pgm",
                                               ".png", ".ppm", ".psd", ".tga", ".tif", ".tiff"};
  const std::string lower = lower_case(suffix);
  if (type.empty()) return others.contains(lower) ? suffix : std::string();
  const std::string usual =
      type == "image/jpeg" ? std::string(".jpg") : fmt::format(".{}", type.substr(type.find('/') + 1));
  return lower == usual || (type == "image/jpeg" && lower == ".jpeg") ? suffix : usual;
}

/// A name for an image's file that is no more than that, whatever the stream calls it: its own last part with
/// a suffix that fits what it is. "" for what is no image.
std::string safe_image_name(const std::string& name, std::span<const std::uint8_t> bytes) {
  std::string stem = one_line(last_part(name));
  std::string suffix;
  if (const std::size_t dot = stem.find_last_of('.'); dot != std::string::npos) {
    suffix = stem.substr(dot);
    stem.resize(dot);
  }
  suffix = image_suffix(suffix, image_type(bytes));
  if (suffix.empty()) return "";
  constexpr std::size_t kMostBytes = 100;
  stem.resize(std::min(stem.size(), kMostBytes));
  stem.erase(0, std::min(stem.find_first_not_of(". "), stem.size()));
  return (stem.empty() ? std::string("image") : stem) + suffix;
}

bool has_bytes(const std::string& path, std::span<const std::uint8_t> bytes) {
  std::ifstream file(path, std::ios::binary);
  const std::string found{std::istreambuf_iterator<char>(file), {}};
  return std::equal(found.begin(), found.end(), bytes.begin(), bytes.end(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

std::string numbers(const std::vector<double>& values) {
  return fmt::format("{:.7g}", fmt::join(values, " "));
}

}  // namespace

void refuse_foreign_file(const std::string& path, const std::string& whose) {
  std::ifstream existing(path, std::ios::binary);
  if (!existing) return;
  std::string mark(std::string_view(kObjMark).size(), '\0');
  existing.read(mark.data(), static_cast<std::streamsize>(mark.size()));
  if (mark == kObjMark) return;
  throw ToolError(ExitStatus::kUsage,
                  fmt::format("{} would get {}, but it exists and another program wrote it: give another "
                              "name for the output",
                              path, whose));
}

std::string MaterialFiles::image_path(const std::string& file_name) const {
  return (std::filesystem::path(path_).parent_path() / file_name).string();
}

void MaterialFiles::choose_images() {
  std::set<std::string> taken;
  for (const auto& [name, bytes] : data_.images()) {
    const std::string wanted = safe_image_name(name, bytes);
    if (wanted.empty()) {
      left_out_.push_back(name);
      continue;
    }
    std::string file = wanted;
    for (int number = 2; !taken.insert(file).second; ++number) file = fmt::format("{}_{}", number, wanted);
    const std::string path = image_path(file);
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) && !has_bytes(path, bytes)) {
      throw ToolError(ExitStatus::kUsage,
                      fmt::format("{} would get an image of the stream, but it exists and is another: give a "
                                  "name in another folder for the output",
                                  path));
    }
    image_files_[name] = file;
  }
}

std::string MaterialFiles::library() {
  if (data_.empty()) return "";
  if (!prepared_) {
    refuse_foreign_file(path_, "the materials");
    choose_images();
    prepared_ = true;
  }
  return std::filesystem::path(path_).filename().string();
}

void MaterialFiles::finish(std::vector<std::string>& files) {
  if (!prepared_) return;
  for (const auto& [name, file_name] : image_files_) {
    const std::vector<std::uint8_t>& bytes = *data_.image(name);
    AtomicFile file(image_path(file_name));
    file.write(bytes.data(), bytes.size());
    file.finish();
    files.push_back(file.path());
  }
  AtomicFile file(path_);
  file.write(mtl());
  file.finish();
  files.push_back(path_);
}

std::vector<std::string> MaterialFiles::notes() const {
  std::vector<std::string> notes;
  if (data_.unreadable())
    notes.emplace_back("the stream's materials are no JSON that can be read: only their names are kept");
  for (const std::string& name : left_out_)
    notes.push_back(fmt::format("{} is no image of a known kind: it is left out", one_line(name)));
  return notes;
}

std::string MaterialFiles::mtl() const {
  std::string text = kObjMark;
  for (const json& material : array_of(data_.json(), "materials")) {
    text += fmt::format("\nnewmtl {}\n{}", one_line(text_of(material, "name")), lines_of(material));
  }
  return text;
}

std::string MaterialFiles::lines_of(const json& material) const {
  const json& mtl = member(member(material, "extras"), "mtl");
  std::string text;
  if (mtl.is_string()) text = mtl.get<std::string>();
  if (mtl.is_array()) {
    for (const json& line : mtl) {
      if (line.is_string()) text += line.get<std::string>() + "\n";
    }
  }
  if (text.empty()) return own_lines_of(material);
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    line = one_line(line);
    std::istringstream words(line);
    std::string word;
    words >> word;
    // The name is the stream's, which has made it the only one of its kind.
    if (!word.empty() && word != "newmtl") result += with_our_images(line) + "\n";
  }
  return result;
}

/// A line of an MTL file that names an image, where that came with the stream, names the file written here.
std::string MaterialFiles::with_our_images(const std::string& line) const {
  const std::size_t first = line.find_first_not_of(" \t");
  const std::string trimmed = first == std::string::npos ? "" : line.substr(first);
  if (!trimmed.starts_with("map_") && !trimmed.starts_with("bump") && !trimmed.starts_with("disp") &&
      !trimmed.starts_with("norm") && !trimmed.starts_with("refl") && !trimmed.starts_with("decal")) {
    return line;
  }
  for (const auto& [data, file] : image_files_) {
    const std::string name = data.substr(data.find('/') + 1);
    const std::size_t at = line.rfind(name);
    if (at != std::string::npos && line.find_last_not_of(" \t") == at + name.size() - 1)
      return line.substr(0, at) + file;
  }
  for (const auto& [name, file] : image_files_) {
    const std::string known = last_part(name);
    if (last_part(line.substr(line.find_last_of(" \t") + 1)) == known)
      return line.substr(0, line.find_last_of(" \t") + 1) + file;
  }
  return line;
}

/// The file of a texture that a material of glTF refers to; "" where there is none.
std::string MaterialFiles::texture_file(const json& texture_info) const {
  const auto index = index_of(texture_info, "index");
  const json& textures = array_of(data_.json(), "textures");
  if (!index || *index >= textures.size()) return "";
  const auto source = index_of(textures[*index], "source");
  const json& images = array_of(data_.json(), "images");
  if (!source || *source >= images.size()) return "";
  const json& image = images[*source];
  if (const auto ours = image_files_.find(text_of(member(image, "extras"), "data"));
      ours != image_files_.end())
    return ours->second;
  const std::string uri = text_of(image, "uri");
  return uri.starts_with("data:") ? "" : one_line(uri);
}

/// What MTL has words for: its usual ones, and those that many programs know of physically based materials.
std::string MaterialFiles::own_lines_of(const json& material) const {
  const json& pbr = member(material, "pbrMetallicRoughness");
  const std::vector<double> base = numbers_of(pbr, "baseColorFactor", 4, 1);
  const auto number = [&pbr](const char* name) {
    const json& value = member(pbr, name);
    return value.is_number() ? value.get<double>() : 1.0;
  };
  const double roughness = number("roughnessFactor");
  std::string text = fmt::format("Kd {}\nNs {}\nPr {}\nPm {}\n", numbers({base[0], base[1], base[2]}),
                                 numbers({std::pow(30 * (1 - roughness), 2)}), numbers({roughness}),
                                 numbers({number("metallicFactor")}));
  if (text_of(material, "alphaMode") == "BLEND" || base[3] < 1)
    text += fmt::format("d {}\n", numbers({base[3]}));
  text += fmt::format("Ke {}\nillum 2\n", numbers(numbers_of(material, "emissiveFactor", 3, 0)));
  const auto add_map = [&](const char* word, const json& info) {
    if (const std::string file = texture_file(info); !file.empty())
      text += fmt::format("{} {}\n", word, file);
  };
  add_map("map_Kd", member(pbr, "baseColorTexture"));
  add_map("map_Ke", member(material, "emissiveTexture"));
  add_map("map_Bump", member(material, "normalTexture"));
  return text;
}

}  // namespace tvg::cli
