#include "encoder/importers/assimp_materials.hpp"

#include "encoder/importers/gltf_uri.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/scene_data.hpp"

#include <algorithm>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

using Json = nlohmann::json;

class MaterialWriter {
 public:
  MaterialWriter(const std::string& path, const aiScene& scene, bool embed_textures,
                 std::vector<std::string>& notes)
      : path_(path), scene_(scene), embed_(embed_textures), notes_(notes) {}

  std::vector<NamedData> write(const std::vector<std::string>& names) {
    Json materials = Json::array();
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].empty()) continue;
      Json material = describe(*scene_.mMaterials[i]);
      material["name"] = names[i];
      materials.push_back(std::move(material));
    }
    if (materials.empty()) return {};
    Json all = {{"materials", std::move(materials)}};
    if (!files_.empty()) {
      all["textures"] = std::move(textures_);
      all["images"] = std::move(list_);
    }
    std::vector<NamedData> data = {json_data("materials", all)};
    for (NamedData& image : images_.finish()) data.push_back(std::move(image));
    return data;
  }

 private:
  static std::optional<double> number(const aiMaterial& material, const char* key) {
    float value = 0;
    if (material.Get(key, 0, 0, value) != aiReturn_SUCCESS || !std::isfinite(value)) return std::nullopt;
    return value;
  }

  static std::optional<Json> colour(const aiMaterial& material, const char* key) {
    aiColor3D value;
    if (material.Get(key, 0, 0, value) != aiReturn_SUCCESS) return std::nullopt;
    if (!std::isfinite(value.r) || !std::isfinite(value.g) || !std::isfinite(value.b)) return std::nullopt;
    return Json{value.r, value.g, value.b};
  }

  Json describe(const aiMaterial& material) {
    Json json = Json::object();
    Json& surface = json["pbrMetallicRoughness"];
    Json base =
        colour(material, "$clr.base").value_or(colour(material, "$clr.diffuse").value_or(Json{1, 1, 1}));
    const double opacity = number(material, "$mat.opacity").value_or(1);
    base.push_back(opacity);
    surface["baseColorFactor"] = std::move(base);
    surface["metallicFactor"] = number(material, "$mat.metallicFactor").value_or(0);
    if (const auto roughness = number(material, "$mat.roughnessFactor"))
      surface["roughnessFactor"] = *roughness;
    if (opacity < 1) json["alphaMode"] = "BLEND";
    if (auto emissive = colour(material, "$clr.emissive")) json["emissiveFactor"] = std::move(*emissive);
    int two_sided = 0;
    if (material.Get(AI_MATKEY_TWOSIDED, two_sided) == aiReturn_SUCCESS && two_sided != 0)
      json["doubleSided"] = true;
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
      if (!surface.contains("baseColorTexture")) refer(material, type, surface, "baseColorTexture");
    }
    refer(material, aiTextureType_NORMALS, json, "normalTexture");
    refer(material, aiTextureType_EMISSIVE, json, "emissiveTexture");
    // What glTF has no word for.
    if (auto specular = colour(material, "$clr.specular")) json["extras"]["specular"] = std::move(*specular);
    if (auto ambient = colour(material, "$clr.ambient")) json["extras"]["ambient"] = std::move(*ambient);
    if (const auto shininess = number(material, "$mat.shininess")) json["extras"]["shininess"] = *shininess;
    return json;
  }

  void refer(const aiMaterial& material, aiTextureType type, Json& json, const char* name) {
    aiString file;
    unsigned set = 0;
    if (material.GetTexture(type, 0, &file, nullptr, &set) != aiReturn_SUCCESS || file.length == 0) return;
    json[name]["index"] = texture(file.C_Str());
    int source = 0;
    if (material.Get(AI_MATKEY_UVWSRC(type, 0), source) == aiReturn_SUCCESS && source > 0)
      json[name]["texCoord"] = source;
  }

  /// The number of the texture that shows a file.
  std::size_t texture(const std::string& file) {
    const auto [entry, is_new] = files_.emplace(file, files_.size());
    if (!is_new) return entry->second;
    textures_.push_back({{"source", entry->second}});
    list_.push_back(image(file));
    return entry->second;
  }

  Json image(const std::string& file) {
    const aiTexture* const embedded = scene_.GetEmbeddedTexture(file.c_str());
    if (embedded == nullptr) return image_beside(file);
    const std::string name = embedded->mFilename.length > 0 ? embedded->mFilename.C_Str() : file;
    std::optional<std::string> data;
    if (embedded->mHeight == 0 && embedded->pcData != nullptr) {
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
      data = images_.add(name, {bytes, bytes + embedded->mWidth});
    }
    if (data) return {{"name", name}, {"extras", {{"data", *data}}}};
    notes_.push_back(
        fmt::format("{}: the picture {} within it is no file of a picture, or larger than {} "
                    "MiB, and left out",
                    path_, name, kMostDataBytes >> 20));
    return {{"name", name}};
  }

  Json image_beside(const std::string& file) {
    Json image = {{"uri", file}};
    if (!embed_) return image;
    try {
      const std::string bytes = read_beside(path_, file);
      if (const auto data = images_.add(file, {bytes.begin(), bytes.end()})) image["extras"]["data"] = *data;
    } catch (const ImportError& error) {
      notes_.push_back(fmt::format("{}: the picture is left out", error.what()));
    }
    return image;
  }

  const std::string& path_;
  const aiScene& scene_;
  bool embed_;
  std::vector<std::string>& notes_;
  std::map<std::string, std::size_t> files_;  // number of the texture and its image
  Json textures_ = Json::array();
  Json list_ = Json::array();  // of images
  SceneImages images_;
};

}  // namespace

std::vector<std::string> name_assimp_materials(const aiScene& scene) {
  std::vector<std::string> names;
  UniqueNames unique;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    const aiMaterial* const material = scene.mMaterials[i];
    const std::string name = material == nullptr ? AI_DEFAULT_MATERIAL_NAME : material->GetName().C_Str();
    const bool stands_for_none = name == AI_DEFAULT_MATERIAL_NAME;
    names.push_back(stands_for_none ? "" : unique.take(name, fmt::format("material {}", i)));
  }
  return names;
}

std::vector<NamedData> read_assimp_data(const std::string& path, const aiScene& scene,
                                        const std::vector<std::string>& names, bool embed_textures,
                                        std::vector<std::string>& notes) {
  return MaterialWriter(path, scene, embed_textures, notes).write(names);
}

}  // namespace tvg::cli
