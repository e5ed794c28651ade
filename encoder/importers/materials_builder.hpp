#pragma once
#include "encoder/importers/mtl_reader.hpp"

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <tvg/properties.hpp>

namespace tvg::cli {

/// The file that another one names, in its folder; a backslash may stand for a slash.
std::optional<std::string> find_beside(const std::filesystem::path& folder, std::string name);

/// Makes the data "materials" and "image/NAME" (tvg/properties.hpp) of material files. Texture names become
/// textures and images once each.
class MaterialsBuilder {
 public:
  /// `notes` outlives it, and takes what cannot be read or is said twice.
  MaterialsBuilder(bool embed_textures, std::vector<std::string>& notes);

  /// The materials of a file. [name in it]: what a material is called, which has a number where another one
  /// that was added before has its name.
  const std::map<std::string, std::string>& add_library(const std::string& path);
  /// A material that is a texture, with its name.
  void add_texture(const std::string& file, const std::filesystem::path& folder);
  /// A material of which nothing but its name is known; nothing where it is known.
  void add_name(const std::string& name);
  /// All of it; empty where there are no materials.
  std::vector<NamedData> take();

 private:
  std::string add(const MtlMaterial& material, const std::filesystem::path& folder);
  nlohmann::json describe(const MtlMaterial& material, const std::filesystem::path& folder);
  nlohmann::json texture(const MtlTexture& texture, const std::filesystem::path& folder);
  std::size_t image(const std::string& name, const std::filesystem::path& folder);

  bool embed_;
  std::vector<std::string>& notes_;
  nlohmann::json json_;
  std::map<std::string, std::size_t> numbers_;  // of materials, by name
  std::map<std::string, std::map<std::string, std::string>> libraries_;
  std::map<std::pair<std::string, std::string>, std::size_t> images_;  // by folder and name
  std::set<std::string> data_names_;
  std::map<std::pair<std::size_t, bool>, std::size_t> textures_;  // by image, and whether it is clamped
  std::vector<NamedData> data_;
};

}  // namespace tvg::cli
