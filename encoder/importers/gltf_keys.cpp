#include "encoder/importers/gltf_keys.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/input_file.hpp"
#include "tool/mesh_format.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kGlbHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;

/// The JSON of a binary file is its first chunk.
std::string_view json_text(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return bytes;
  const std::size_t start = kGlbHeaderSize + kChunkHeaderSize;
  if (bytes.size() < start) return {};
  const std::size_t length = load<std::uint32_t>(bytes.data() + kGlbHeaderSize, false);
  return bytes.substr(start, length);
}

/// A member of an object; null where it is none or there is no such.
const Json& member(const Json& object, const char* name) {
  static const Json nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(name);
  return found == object.end() ? nothing : *found;
}

const Json& element(const Json& array, std::size_t index) {
  static const Json nothing;
  return array.is_array() && index < array.size() ? array[index] : nothing;
}

}  // namespace

GltfKeys find_gltf_keys(const std::string& path, std::size_t clip) {
  if (!has_suffix(path, ".gltf") && !has_suffix(path, ".glb")) return {};
  std::string bytes;
  read_file(path, bytes);
  return parse_gltf_keys(bytes, clip);
}

GltfKeys parse_gltf_keys(std::string_view bytes, std::size_t clip) {
  GltfKeys keys;
  const Json json = Json::parse(json_text(bytes), nullptr, false);
  const Json& animation = element(member(json, "animations"), clip);
  const Json& channels = member(animation, "channels");
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Json& number = member(element(channels, i), "sampler");
    if (!number.is_number_unsigned()) continue;
    const Json& sampler = element(member(animation, "samplers"), number.get<std::size_t>());
    const Json& interpolation = member(sampler, "interpolation");
    if (interpolation == "STEP") keys.has_steps = true;
    if (interpolation != "CUBICSPLINE") continue;
    keys.has_curves = true;
    const bool morphs = member(member(element(channels, i), "target"), "path") == "weights";
    keys.has_curved_morphs = keys.has_curved_morphs || morphs;
  }
  return keys;
}

}  // namespace tvg::cli
