#pragma once
#include "decoder/exporters/gltf_buffer.hpp"
#include "decoder/exporters/material_data.hpp"

#include <map>
#include <set>
#include <string>

namespace tvg::cli {

/// Materials of a glTF file: those of the stream nearly as they are, and one of the name alone for whatever
/// else parts refer to.
class GltfMaterials {
 public:
  void add_data(const NamedData& data) { data_.add(data); }
  /// The number of a material; the same for the same name.
  std::size_t number_of(const std::string& name);
  /// Puts them into the document, images into the buffer. `texcoord_sets`: those that every mesh has;
  /// textures that need others are left out.
  void write(nlohmann::json& document, GltfBuffer& buffer, std::size_t texcoord_sets);
  /// Extensions that what was written uses.
  const std::set<std::string>& extensions() const { return extensions_; }
  std::vector<std::string> notes() const;

 private:
  void number_those_of_the_stream();
  nlohmann::json image(nlohmann::json described, GltfBuffer& buffer);
  void clean_textures(nlohmann::json& material, std::size_t texture_count, std::size_t texcoord_sets);
  void collect_extensions(const nlohmann::json& value);

  MaterialData data_;
  std::map<std::string, std::size_t> numbers_;
  nlohmann::json materials_ = nlohmann::json::array();
  bool numbered_ = false;
  bool lost_textures_ = false;
  bool strange_images_ = false;
  std::set<std::string> extensions_;
};

}  // namespace tvg::cli
