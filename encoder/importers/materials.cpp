#include "encoder/importers/materials.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/mtl_reader.hpp"
#include "encoder/importers/part_table.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The file that another one names; a backslash may stand for a slash.
std::optional<std::string> find_file(const fs::path& folder, std::string name) {
  std::error_code ignored;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const fs::path path = folder / fs::path(name);
    if (fs::is_regular_file(path, ignored)) return path.string();
    std::replace(name.begin(), name.end(), '\\', '/');
  }
  return std::nullopt;
}

/// Makes the JSON of materials; texture names become textures and images once each.
class MaterialsBuilder {
 public:
  MaterialsBuilder(bool embed_textures, std::vector<std::string>& notes)
      : embed_(embed_textures), notes_(notes) {
    for (const char* array : {"materials", "textures", "images", "samplers"}) json_[array] = json::array();
  }

  void add_library(const std::string& path);
  /// A material that is a texture, with its name.
  void add_texture(const std::string& file, const fs::path& folder) {
    if (!names_.insert(file).second) return;
    MtlMaterial material;
    material.name = file;
    material.diffuse_map.file = file;
    add(material, folder);
  }
  /// A material of which nothing but its name is known; nothing where it is known.
  void add_name(const std::string& name) {
    if (!names_.insert(name).second) return;
    json_["materials"].push_back({{"name", name}});
  }
  std::vector<NamedData> take();

 private:
  void add(const MtlMaterial& material, const fs::path& folder);
  json texture(const MtlTexture& texture, const fs::path& folder);
  std::size_t image(const std::string& name, const fs::path& folder);

  bool embed_;
  std::vector<std::string>& notes_;
  json json_;
  std::set<std::string> names_;
  std::map<std::string, std::size_t> images_;
  std::map<std::pair<std::size_t, bool>, std::size_t> textures_;  // by image, and whether it is clamped
  std::vector<NamedData> data_;
};

void MaterialsBuilder::add_library(const std::string& path) {
  std::string bytes;
  try {
    read_file(path, bytes);
    for (const MtlMaterial& material : parse_mtl(path, bytes)) {
      if (names_.insert(material.name).second) {
        add(material, fs::path(path).parent_path());
      } else {
        notes_.push_back(fmt::format("{}: a second material '{}' is left out", path, material.name));
      }
    }
  } catch (const EmptyInputError&) {
    return;
  } catch (const ImportError& error) {
    notes_.push_back(fmt::format("{}: its materials are left out", error.what()));
  }
}

/// How rough a surface of Phong's exponent looks, as Blender has it.
double roughness_of(float shininess) {
  return 1 - std::sqrt(std::clamp(static_cast<double>(shininess), 0.0, 1000.0) / 1000);
}

/// A float as the shortest decimal that is that float.
double shortest(float value) {
  return std::stod(fmt::format("{}", value));
}

void MaterialsBuilder::add(const MtlMaterial& material, const fs::path& folder) {
  json pbr = {{"metallicFactor", material.metallic ? shortest(*material.metallic) : 0.0}};
  if (material.roughness) {
    pbr["roughnessFactor"] = shortest(*material.roughness);
  } else if (material.shininess) {
    pbr["roughnessFactor"] = roughness_of(*material.shininess);
  }
  const float opacity = material.opacity.value_or(1);
  const bool mapped = !material.diffuse_map.file.empty();
  if (material.diffuse || opacity < 1) {
    const std::array<float, 3> diffuse = material.diffuse.value_or(std::array<float, 3>{1, 1, 1});
    pbr["baseColorFactor"] = {shortest(diffuse[0]), shortest(diffuse[1]), shortest(diffuse[2]),
                              shortest(opacity)};
  }
  if (mapped) pbr["baseColorTexture"] = texture(material.diffuse_map, folder);
  json described = {{"name", material.name}, {"pbrMetallicRoughness", std::move(pbr)}};
  if (material.emissive && *material.emissive != std::array<float, 3>{})
    described["emissiveFactor"] = {shortest((*material.emissive)[0]), shortest((*material.emissive)[1]),
                                   shortest((*material.emissive)[2])};
  if (!material.emissive_map.file.empty()) {
    described["emissiveTexture"] = texture(material.emissive_map, folder);
    if (!material.emissive || *material.emissive == std::array<float, 3>{})
      described["emissiveFactor"] = {1, 1, 1};
  }
  if (!material.normal_map.file.empty()) described["normalTexture"] = texture(material.normal_map, folder);
  if (opacity < 1 || !material.opacity_map.file.empty()) described["alphaMode"] = "BLEND";
  if (!material.lines.empty()) described["extras"]["mtl"] = material.lines;
  json_["materials"].push_back(std::move(described));
}

json MaterialsBuilder::texture(const MtlTexture& texture, const fs::path& folder) {
  const std::size_t source = image(texture.file, folder);
  const auto [known, is_new] =
      textures_.emplace(std::pair(source, texture.clamped), json_["textures"].size());
  if (is_new) {
    json described = {{"source", source}};
    if (texture.clamped) {
      constexpr int kClampToEdge = 33071;
      if (json_["samplers"].empty())
        json_["samplers"].push_back({{"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}});
      described["sampler"] = 0;
    }
    json_["textures"].push_back(std::move(described));
  }
  return {{"index", known->second}};
}

std::size_t MaterialsBuilder::image(const std::string& name, const fs::path& folder) {
  const auto [known, is_new] = images_.emplace(name, json_["images"].size());
  if (!is_new) return known->second;
  constexpr const char* kPrefix = "image/";
  const std::optional<std::string> path = embed_ ? find_file(folder, name) : std::nullopt;
  NamedData data{kPrefix + name, {}};
  if (path) {
    std::string bytes;
    read_file(*path, bytes);
    data.bytes.assign(bytes.begin(), bytes.end());
  } else if (embed_) {
    notes_.push_back(fmt::format("{}: there is no such texture in {}; it is kept by its name", name,
                                 folder.empty() ? "." : folder.string()));
  }
  if (data.bytes.empty()) {
    json_["images"].push_back({{"uri", name}});
  } else {
    json_["images"].push_back({{"extras", {{"data", data.name}}}});
    data_.push_back(std::move(data));
  }
  return known->second;
}

std::vector<NamedData> MaterialsBuilder::take() {
  if (json_["materials"].empty()) return {};
  const std::string text = json_.dump();
  data_.insert(data_.begin(), {"materials", {text.begin(), text.end()}});
  return std::move(data_);
}

/// The files of a line `mtllib`: one whose name may have blanks, or several.
std::vector<std::string> libraries_of(const std::string& line, const fs::path& folder,
                                      std::vector<std::string>& missing) {
  if (const auto whole = find_file(folder, line)) return {*whole};
  std::vector<std::string> found;
  std::istringstream words(line);
  std::vector<std::string> absent;
  for (std::string word; words >> word;) {
    if (auto path = find_file(folder, word)) {
      found.push_back(std::move(*path));
    } else {
      absent.push_back(word);
    }
  }
  if (found.empty()) {
    missing.push_back(line);
  } else {
    missing.insert(missing.end(), absent.begin(), absent.end());
  }
  return found;
}

}  // namespace

std::vector<NamedData> read_materials(const std::string& mesh_path, const MeshFile& mesh, bool embed_textures,
                                      std::vector<std::string>& notes) {
  const fs::path folder = fs::path(mesh_path).parent_path();
  MaterialsBuilder builder(embed_textures, notes);
  std::vector<std::string> missing;
  std::set<std::string> read;
  for (const std::string& line : mesh.material_files) {
    for (const std::string& path : libraries_of(line, folder, missing)) {
      if (read.insert(path).second) builder.add_library(path);
    }
  }
  for (const std::string& name : missing) {
    bool latin = false;
    notes.push_back(fmt::format("{}: its material file {} is not there: of its materials only names are kept",
                                mesh_path, readable_name(name, latin)));
  }
  for (const std::string& file : mesh.texture_files) builder.add_texture(file, folder);
  for (const Part& part : mesh.parts) {
    if (!part.material.empty()) builder.add_name(part.material);
  }
  return builder.take();
}

}  // namespace tvg::cli
