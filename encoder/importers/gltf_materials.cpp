#include "encoder/importers/gltf_materials.hpp"

#include "encoder/importers/gltf_uri.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/scene_data.hpp"

#include <fmt/format.h>

namespace tvg::cli {

namespace {

using Json = nlohmann::json;

std::string text_of(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

class DataReader {
 public:
  DataReader(const std::string& path, const GltfDocument& document, GltfAccessors& accessors,
             bool embed_textures, std::vector<std::string>& notes)
      : path_(path), document_(document), accessors_(accessors), embed_(embed_textures), notes_(notes) {}

  std::vector<NamedData> read() {
    if (!document_.materials.contains("materials") || document_.materials["materials"].empty()) {
      add("extras", document_.extras);
      return std::move(data_);
    }
    Json materials = document_.materials;
    if (materials.contains("images")) {
      for (std::size_t i = 0; i < materials["images"].size(); ++i) {
        Json& image = materials["images"][i];
        if (image.is_object()) take_image(i, image);
      }
    }
    add("materials", materials);
    add("extras", document_.extras);
    for (NamedData& image : images_.finish()) data_.push_back(std::move(image));
    return std::move(data_);
  }

 private:
  void add(const char* name, const Json& json) {
    if (json.empty()) return;
    NamedData data = json_data(name, json);
    if (data.bytes.size() > kMostDataBytes) {
      notes_.push_back(
          fmt::format("{}: its {} are larger than {} MiB and left out", path_, name, kMostDataBytes >> 20));
      return;
    }
    data_.push_back(std::move(data));
  }

  /// Images by the name of a file are passed on as they are.
  void take_image(std::size_t index, Json& image) {
    const std::string uri = text_of(image, "uri");
    const bool is_embedded = uri.starts_with("data:");
    const bool is_file = !is_embedded && !uri.empty();
    if (is_file ? !embed_ : !is_embedded && !image.contains("bufferView")) return;
    const std::string what = fmt::format("image {}", index);
    std::optional<std::string> name;
    try {
      if (is_file) {
        const std::string bytes = accessors_.file(uri);
        name = add_image(what, image, {bytes.begin(), bytes.end()});
      } else {
        name = is_embedded ? read_uri(what, image, uri) : read_view(what, image);
      }
    } catch (const ImportError& error) {
      notes_.push_back(fmt::format("{}: {} is left out", error.what(), what));
    }
    if (!is_file) image.erase(is_embedded ? "uri" : "bufferView");
    if (!name) return;
    if (!image["extras"].is_object()) image["extras"] = Json::object();
    image["extras"]["data"] = *name;
  }

  std::optional<std::string> read_uri(const std::string& what, Json& image, const std::string& uri) {
    const std::optional<std::string> bytes = decode_data_uri(uri);
    if (!bytes) {
      notes_.push_back(fmt::format("{}: {} is not well-formed base64 and left out", path_, what));
      return std::nullopt;
    }
    const std::string type = uri.substr(5, uri.find_first_of(";,") - 5);
    if (!image.contains("mimeType") && !type.empty()) image["mimeType"] = type;
    return add_image(what, image, {bytes->begin(), bytes->end()});
  }

  std::optional<std::string> read_view(const std::string& what, const Json& image) {
    const Json& number = image["bufferView"];
    const int view = number.is_number_integer() ? number.get<int>() : -1;
    if (const auto known = of_view_.find(view); known != of_view_.end()) return known->second;
    const std::span<const unsigned char> bytes = accessors_.view(view);
    taken_ += bytes.size();
    // Views of a stranger may be the same bytes over and over.
    if (taken_ > accessors_.bytes()) {
      notes_.push_back(fmt::format("{}: {} shares bytes with others and is left out", path_, what));
      return std::nullopt;
    }
    std::optional<std::string> name = add_image(what, image, {bytes.begin(), bytes.end()});
    if (name) of_view_.emplace(view, *name);
    return name;
  }

  std::optional<std::string> add_image(const std::string& what, const Json& image,
                                       std::vector<std::uint8_t> bytes) {
    std::optional<std::string> name = images_.add(text_of(image, "name"), std::move(bytes));
    if (!name) {
      notes_.push_back(
          fmt::format("{}: {} is larger than {} MiB and left out", path_, what, kMostDataBytes >> 20));
    }
    return name;
  }

  const std::string& path_;
  const GltfDocument& document_;
  GltfAccessors& accessors_;
  bool embed_;
  std::vector<std::string>& notes_;
  SceneImages images_;
  std::map<int, std::string> of_view_;  // name of the data
  std::uint64_t taken_ = 0;             // bytes of views
  std::vector<NamedData> data_;
};

}  // namespace

std::vector<std::string> name_gltf_materials(GltfDocument& document) {
  std::vector<std::string> names;
  if (!document.materials.contains("materials")) return names;
  UniqueNames unique;
  for (Json& material : document.materials["materials"]) {
    if (!material.is_object()) material = Json::object();
    names.push_back(unique.take(text_of(material, "name"), fmt::format("material {}", names.size())));
    material["name"] = names.back();
  }
  return names;
}

std::vector<NamedData> read_gltf_data(const std::string& path, const GltfDocument& document,
                                      GltfAccessors& accessors, bool embed_textures,
                                      std::vector<std::string>& notes) {
  return DataReader(path, document, accessors, embed_textures, notes).read();
}

}  // namespace tvg::cli
