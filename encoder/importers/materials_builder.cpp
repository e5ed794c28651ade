#include "encoder/importers/materials_builder.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace tvg::cli {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// How rough a surface of Phong's exponent looks, as Blender has it.
double roughness_of(float shininess) {
  return 1 - std::sqrt(std::clamp(static_cast<double>(shininess), 0.0, 1000.0) / 1000);
}

/// A float as the shortest decimal that is that float.
double shortest(float value) {
  return std::stod(fmt::format("{}", value));
}

}  // namespace

std::optional<std::string> find_beside(const fs::path& folder, std::string name) {
  std::error_code ignored;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const fs::path path = folder / fs::path(name);
    if (fs::is_regular_file(path, ignored)) return path.string();
    std::replace(name.begin(), name.end(), '\\', '/');
  }
  return std::nullopt;
}

MaterialsBuilder::MaterialsBuilder(bool embed_textures, std::vector<std::string>& notes)
    : embed_(embed_textures), notes_(notes) {
  for (const char* array : {"materials", "textures", "images", "samplers"}) json_[array] = json::array();
}

const std::map<std::string, std::string>& MaterialsBuilder::add_library(const std::string& path) {
  const auto [library, is_new] = libraries_.try_emplace(path);
  std::map<std::string, std::string>& names = library->second;
  if (!is_new) return names;
  std::string bytes;
  try {
    read_file(path, bytes);
    for (const MtlMaterial& material : parse_mtl(path, bytes)) {
      if (names.contains(material.name)) {
        notes_.push_back(fmt::format("{}: a second material '{}' is left out", path, material.name));
      } else {
        names.emplace(material.name, add(material, fs::path(path).parent_path()));
      }
    }
  } catch (const EmptyInputError&) {
    return names;
  } catch (const ImportError& error) {
    notes_.push_back(fmt::format("{}: its materials are left out", error.what()));
  }
  return names;
}

void MaterialsBuilder::add_texture(const std::string& file, const fs::path& folder) {
  if (numbers_.contains(file)) return;
  MtlMaterial material;
  material.name = file;
  material.diffuse_map.file = file;
  add(material, folder);
}

void MaterialsBuilder::add_name(const std::string& name) {
  if (!numbers_.emplace(name, json_["materials"].size()).second) return;
  json_["materials"].push_back({{"name", name}});
}

/// Gives its name: one that says the same is there already, or has another name.
std::string MaterialsBuilder::add(const MtlMaterial& material, const fs::path& folder) {
  json described = describe(material, folder);
  std::string name = material.name;
  for (int number = 2;; ++number) {
    described["name"] = name;
    const auto [known, is_new] = numbers_.emplace(name, json_["materials"].size());
    if (!is_new && json_["materials"][known->second] == described) return name;
    if (is_new) break;
    name = fmt::format("{} {}", material.name, number);
  }
  json_["materials"].push_back(std::move(described));
  return name;
}

json MaterialsBuilder::describe(const MtlMaterial& material, const fs::path& folder) {
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
  return described;
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
  const auto [known, is_new] = images_.emplace(std::pair(folder.string(), name), json_["images"].size());
  if (!is_new) return known->second;
  constexpr const char* kPrefix = "image/";
  const std::optional<std::string> path = embed_ ? find_beside(folder, name) : std::nullopt;
  NamedData data{kPrefix + name, {}};
  if (path) {
    std::string bytes;
    read_file(*path, bytes);
    data.bytes.assign(bytes.begin(), bytes.end());
    for (int number = 2; !data_names_.insert(data.name).second; ++number)
      data.name = fmt::format("{}{}/{}", kPrefix, number, name);
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

}  // namespace tvg::cli
