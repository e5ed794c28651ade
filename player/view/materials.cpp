#include "player/view/materials.hpp"

#include "player/view/picture_file.hpp"
#include "tool/percent_decoded.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

namespace tvg::player {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{1} << 26;

/// A member of an object, or null where it is none or has none.
const json& member(const json& object, const char* key) {
  static const json kNone;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() ? kNone : *found;
}

/// The entry of an array that an index names, or null.
const json& entry(const json& array, const json& index) {
  static const json kNone;
  if (!array.is_array() || !index.is_number_unsigned() || index.get<std::size_t>() >= array.size())
    return kNone;
  return array[index.get<std::size_t>()];
}

std::string text(const json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

float number(const json& value, float otherwise) {
  if (!value.is_number()) return otherwise;
  const float given = value.get<float>();
  return std::isfinite(given) ? given : otherwise;
}

/// A file of the folder or below; nothing for one elsewhere, and where it cannot be read.
std::vector<std::uint8_t> read_beside(const std::string& folder, const std::string& uri) {
  std::error_code error;
  std::string decoded = cli::percent_decoded(uri);
  std::ranges::replace(decoded, '\\', '/');
  const fs::path name = decoded;
  if (folder.empty() || name.is_absolute() || std::ranges::count(name, fs::path("..")) > 0) return {};
  const fs::path path = fs::path(folder) / name;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > kMostFileBytes || error) return {};
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

class ShownMaterials::Reader {
 public:
  Reader(ShownMaterials& materials, const std::string& folder)
      : materials_(materials),
        folder_(folder),
        json_(json::parse(materials.json_.begin(), materials.json_.end(), nullptr, false)) {}

  void read() {
    const json& described = member(json_, "materials");
    if (!described.is_array()) return;
    for (const json& material : described) read_material(material);
  }

 private:
  void read_material(const json& material) {
    ShownMaterial shown;
    const json& surface = member(material, "pbrMetallicRoughness");
    const json& factor = member(surface, "baseColorFactor");
    for (std::size_t i = 0; factor.is_array() && i < std::min(shown.factor.size(), factor.size()); ++i)
      shown.factor[i] = std::clamp(number(factor[i], 1), 0.0F, 1.0F);
    const json& texture = member(surface, "baseColorTexture");
    const json& source = member(entry(member(json_, "textures"), member(texture, "index")), "source");
    shown.texture = picture(entry(member(json_, "images"), source));
    const json& texcoord = member(texture, "texCoord");
    if (texcoord.is_number_unsigned()) shown.texcoord = texcoord.get<std::size_t>();
    if (text(member(material, "alphaMode")) == "MASK")
      shown.cutoff = number(member(material, "alphaCutoff"), 0.5F);
    materials_.materials_.emplace(text(member(material, "name")), std::move(shown));
  }

  std::shared_ptr<const Image> picture(const json& image) {
    const std::string data = text(member(member(image, "extras"), "data"));
    const std::string uri = text(member(image, "uri"));
    const std::string& name = data.empty() ? uri : data;
    if (name.empty()) return nullptr;
    const auto [known, is_new] = known_.emplace(name, nullptr);
    if (!is_new) return known->second;
    const auto stored = materials_.pictures_.find(data);
    std::optional<Image> read =
        decode_picture(stored != materials_.pictures_.end() ? stored->second : read_beside(folder_, uri));
    if (read) {
      known->second = std::make_shared<const Image>(*std::move(read));
    } else {
      materials_.missing_.push_back(name);
    }
    return known->second;
  }

  ShownMaterials& materials_;
  const std::string& folder_;
  const json json_;
  std::map<std::string, std::shared_ptr<const Image>> known_;
};

void ShownMaterials::take(NamedData data) {
  if (data.name == "materials")
    json_ = std::move(data.bytes);
  else if (data.name.starts_with("image/"))
    pictures_[data.name] = std::move(data.bytes);
}

void ShownMaterials::make(const std::string& folder) {
  if (!json_.empty()) Reader(*this, folder).read();
  json_ = {};
  pictures_.clear();
}

std::string ShownMaterials::note() const {
  if (missing_.empty()) return {};
  const std::string more =
      missing_.size() == 1 ? "" : " and " + std::to_string(missing_.size() - 1) + " more";
  return "texture " + missing_.front() + more + ": not there, or no PNG or JPEG; drawn without";
}

const ShownMaterial* ShownMaterials::find(const std::string& name) const {
  const auto found = materials_.find(name);
  return found == materials_.end() ? nullptr : &found->second;
}

}  // namespace tvg::player
