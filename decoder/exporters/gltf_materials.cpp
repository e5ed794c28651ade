#include "decoder/exporters/gltf_materials.hpp"

#include "decoder/exporters/gltf_material_repair.hpp"

#include <algorithm>

namespace tvg::cli {

using nlohmann::json;

namespace {

/// A name of a file as a URI has it. Names of programs other than glTF's have blanks and backslashes, and may
/// be those of another machine's disk ("C:/pictures/wood.jpg"), of which the last part is kept.
std::string as_uri(std::string name) {
  const bool is_of_a_disk =
      name.starts_with('/') || name.starts_with('\\') || (name.size() > 1 && name[1] == ':');
  if (is_of_a_disk) name.erase(0, name.find_last_of("/\\:") + 1);
  std::string uri;
  for (const char c : name) {
    if (c == ' ') {
      uri += "%20";
    } else {
      uri += c == '\\' ? '/' : c;
    }
  }
  return uri;
}

/// Removes an index that points beyond an array.
void keep_index_below(json& object, const char* name, std::size_t count) {
  if (!object.contains(name)) return;
  const auto index = index_of(object, name);
  if (!index || *index >= count) object.erase(name);
}

}  // namespace

void GltfMaterials::number_those_of_the_stream() {
  if (numbered_) return;
  numbered_ = true;
  for (const json& material : array_of(data_.json(), "materials")) {
    const std::string name = text_of(material, "name");
    numbers_.emplace(name, materials_.size());
    materials_.push_back(material.is_object() ? material : json{{"name", name}});
  }
}

std::size_t GltfMaterials::number_of(const std::string& name) {
  number_those_of_the_stream();
  const auto [place, is_new] = numbers_.emplace(name, materials_.size());
  if (is_new) materials_.push_back({{"name", name}});
  return place->second;
}

json GltfMaterials::image(json described, GltfBuffer& buffer) {
  if (!described.is_object()) described = json::object();
  const std::string data = text_of(member(described, "extras"), "data");
  std::string name = text_of(described, "uri");
  described.erase("uri");
  described.erase("bufferView");
  if (described.contains("extras") && described["extras"].is_object()) {
    described["extras"].erase("data");
    if (described["extras"].empty()) described.erase("extras");
  }
  const std::vector<std::uint8_t>* bytes = data_.image(data);
  const std::string type = bytes == nullptr ? "" : image_type(*bytes);
  if (!type.empty()) {
    buffer.begin_view(GltfTarget::kNone);
    buffer.write(*bytes);
    buffer.end_view();
    described["bufferView"] = buffer.view();
    described["mimeType"] = type;
    if (name.empty()) name = data.substr(data.find('/') + 1);
    if (!described.contains("name") && !name.empty()) described["name"] = name;
    return described;
  }
  if (name.empty()) name = data.empty() ? text_of(described, "name") : data.substr(data.find('/') + 1);
  described.erase("mimeType");
  if (bytes != nullptr) strange_images_ = true;
  described["uri"] = as_uri(name.empty() ? "missing.png" : name);
  return described;
}

void GltfMaterials::clean_textures(json& material, std::size_t texture_count, std::size_t texcoord_sets) {
  if (!material.is_object()) return;
  for (auto entry = material.begin(); entry != material.end();) {
    json& value = entry.value();
    if (entry.key().ends_with("Texture") && value.is_object() && value.contains("index")) {
      const auto index = index_of(value, "index");
      const json& transform = member(member(value, "extensions"), "KHR_texture_transform");
      const std::size_t set =
          index_of(transform, "texCoord").value_or(index_of(value, "texCoord").value_or(0));
      if (!index || *index >= texture_count || set >= texcoord_sets) {
        lost_textures_ = true;
        entry = material.erase(entry);
        continue;
      }
    }
    clean_textures(value, texture_count, texcoord_sets);
    ++entry;
  }
}

void GltfMaterials::collect_extensions(const json& value) {
  if (!value.is_structured()) return;
  for (const auto& [key, inner] : value.items()) {
    if (key == "extras") continue;
    if (key == "extensions" && inner.is_object()) {
      for (const auto& [name, extension] : inner.items()) extensions_.insert(name);
    }
    collect_extensions(inner);
  }
}

void GltfMaterials::write(json& document, GltfBuffer& buffer, std::size_t texcoord_sets) {
  number_those_of_the_stream();
  json images = json::array();
  for (const json& described : array_of(data_.json(), "images")) images.push_back(image(described, buffer));
  json samplers = array_of(data_.json(), "samplers");
  json textures = array_of(data_.json(), "textures");
  for (json& texture : textures) {
    if (!texture.is_object()) texture = json::object();
    keep_index_below(texture, "source", images.size());
    keep_index_below(texture, "sampler", samplers.size());
  }
  for (json& material : materials_) {
    repair_gltf_material(material);
    clean_textures(material, textures.size(), texcoord_sets);
  }
  document["materials"] = materials_;
  document["textures"] = std::move(textures);
  document["images"] = std::move(images);
  document["samplers"] = std::move(samplers);
  for (const char* name : {"materials", "textures", "images", "samplers"}) collect_extensions(document[name]);
}

std::vector<std::string> GltfMaterials::notes() const {
  std::vector<std::string> notes;
  if (data_.unreadable())
    notes.emplace_back("the stream's materials are no JSON that can be read: only their names are kept");
  if (strange_images_)
    notes.emplace_back(
        "images that are no PNG, JPEG, WebP or KTX 2 are named only: glTF does not embed them");
  if (lost_textures_)
    notes.emplace_back(
        "textures that materials name are left out where there are no texture coordinates for them");
  return notes;
}

}  // namespace tvg::cli
