#include "encoder/importers/gltf_document.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/gltf_extensions.hpp"
#include "encoder/importers/import_error.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;

/// Entries of a stream's metadata that come back, and bytes of each key and value.
constexpr std::size_t kMostMetadata = 64;
constexpr std::size_t kLongestMetadata = 1024;

/// Of objects and lists in each other; what is read of glTF has 8.
constexpr int kMostDepth = 64;

[[noreturn]] void fail(const std::string& path, const std::string& what,
                       ErrorCode code = ErrorCode::kInvalidInput) {
  throw ImportError(code, path + what);
}

struct Container {
  std::string_view json;
  std::optional<std::string_view> binary;
  std::uint32_t version = 2;
};

/// The chunks of a binary file. What follows JSON and buffer is for others.
Container split_binary(const std::string& path, std::string_view bytes) {
  if (bytes.size() < kHeaderSize) fail(path, " ends in its header", ErrorCode::kTruncated);
  Container container;
  container.version = load<std::uint32_t>(bytes.data() + 4, false);
  if (container.version == 1) return container;
  const std::uint64_t size = load<std::uint32_t>(bytes.data() + 8, false);
  if (size > bytes.size()) {
    fail(path, fmt::format(" ends at byte {}; its header promises {} bytes", bytes.size(), size),
         ErrorCode::kTruncated);
  }
  std::uint64_t begin = kHeaderSize;
  for (int chunk = 0; chunk < 2 && begin + kChunkHeaderSize <= size; ++chunk) {
    const std::uint64_t length = load<std::uint32_t>(bytes.data() + begin, false);
    const auto kind = load<std::uint32_t>(bytes.data() + begin + 4, false);
    const std::uint64_t left = size - begin - kChunkHeaderSize;
    if (length > left) {
      fail(path,
           fmt::format(", byte {}: a chunk of {} bytes is promised where {} are left", begin, length, left));
    }
    const std::string_view content = bytes.substr(begin + kChunkHeaderSize, length);
    if (chunk == 0 && kind != kJsonChunk) fail(path, ": its first chunk is not JSON");
    if (chunk == 0) container.json = content;
    if (chunk == 1 && kind == kBinaryChunk) container.binary = content;
    begin += kChunkHeaderSize + length;
  }
  return container;
}

/// Whether brackets are nested no deeper than is read, whatever else the text is.
bool is_shallow(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMostDepth) return false;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return true;
}

Json parse_json(const std::string& path, std::string_view text) {
  while (!text.empty() && text.back() == '\0') text.remove_suffix(1);  // padding of careless exporters
  if (!is_shallow(text)) fail(path, fmt::format(": its JSON is nested more than {} deep", kMostDepth));
  try {
    Json json = Json::parse(text);
    if (!json.is_object()) fail(path, ": it is no glTF: its JSON is no object");
    return json;
  } catch (const Json::exception& error) {
    fail(path, fmt::format(": it cannot be read as what its suffix says: {}", error.what()));
  }
}

/// The member of an object; null where it is none or there is no such.
const Json& member(const Json& object, const char* name) {
  static const Json nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(name);
  return found == object.end() ? nothing : *found;
}

/// The first number of "2.0", and whether nothing but zeros follow.
struct Version {
  int major = 0;
  bool is_plain = false;
};

Version parse_version(const Json& text) {
  Version version;
  if (!text.is_string()) return version;
  const auto& digits = text.get_ref<const std::string&>();
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), version.major);
  if (error != std::errc()) return {};
  version.is_plain =
      std::all_of(end, digits.data() + digits.size(), [](char c) { return c == '.' || c == '0'; });
  return version;
}

int check_version(const std::string& path, const Json& json) {
  const Json& asset = member(json, "asset");
  const Version version = parse_version(member(asset, "version"));
  if (version.major == 0) fail(path, ": it is no glTF: its JSON has no \"asset\" with a version");
  const Json& least = member(asset, "minVersion");
  const Version needed = least.is_null() ? Version{2, true} : parse_version(least);
  if (version.major > 2 || needed.major > 2 || (needed.major == 2 && !needed.is_plain)) {
    fail(path, fmt::format(": it is glTF {}: 2.0 is read",
                           (least.is_null() ? member(asset, "version") : least).dump()));
  }
  return version.major;
}

std::vector<std::string> texts(const Json& list) {
  std::vector<std::string> result;
  if (!list.is_array()) return result;
  for (const Json& text : list) {
    if (text.is_string()) result.push_back(text.get<std::string>());
  }
  return result;
}

std::vector<GltfBufferInfo> read_buffers(const std::string& path, const Json& list) {
  std::vector<GltfBufferInfo> buffers;
  if (!list.is_array()) return buffers;
  for (const Json& buffer : list) {
    GltfBufferInfo& info = buffers.emplace_back();
    const Json& size = member(buffer, "byteLength");
    if (!size.is_number_unsigned())
      fail(path, fmt::format(": buffer {} has no byteLength", buffers.size() - 1));
    info.size = size.get<std::uint64_t>();
    if (member(buffer, "uri").is_string()) info.uri = member(buffer, "uri").get<std::string>();
    for (const char* extension : kMeshoptExtensions) {
      const Json& fallback = member(member(member(buffer, "extensions"), extension), "fallback");
      info.is_fallback = info.is_fallback || fallback == true;
    }
  }
  return buffers;
}

/// The lists that describe materials, moved out of the file's JSON.
Json take_materials(Json& json) {
  Json taken = Json::object();
  for (const char* list : {"materials", "textures", "images", "samplers"}) {
    if (member(json, list).is_array()) taken[list] = std::move(json[list]);
  }
  return taken;
}

/// `extras` of a list's members, each with its number and name.
Json listed_extras(const Json& list) {
  Json found = Json::array();
  for (std::size_t i = 0; list.is_array() && i < list.size(); ++i) {
    const Json& extras = member(list[i], "extras");
    if (extras.is_null()) continue;
    found.push_back({{"index", i}, {"extras", extras}});
    if (member(list[i], "name").is_string()) found.back()["name"] = list[i]["name"];
  }
  return found;
}

Json collect_extras(const Json& json, bool is_own) {
  Json extras = Json::object();
  // Nodes and meshes of our own files are not those that their extras were of.
  if (is_own && member(json, "extras").is_object()) extras = json["extras"];
  const Json& scenes = member(json, "scenes");
  const Json& shown = member(json, "scene");
  const std::size_t index = shown.is_number_unsigned() ? shown.get<std::size_t>() : 0;
  if (scenes.is_array() && index < scenes.size()) {
    const Json& of_scene = member(scenes[index], "extras");
    if (!of_scene.is_null()) extras["scene"] = of_scene;
  }
  if (is_own) return extras;
  for (const char* list : {"nodes", "meshes"}) {
    if (Json found = listed_extras(member(json, list)); !found.empty()) extras[list] = std::move(found);
  }
  return extras;
}

/// What a stream said of itself; how its coordinates lie is what nodes say.
Metadata read_metadata(const Json& extras) {
  Metadata metadata;
  const Json& kept = member(extras, "metadata");
  if (!kept.is_object()) return metadata;
  for (const auto& [key, value] : kept.items()) {
    const bool is_told = key == "up" || key == "units" || key == "origin" || key == "fps" || key == "start" ||
                         key == "shading";
    if (is_told || key.empty() || !value.is_string() || metadata.size() == kMostMetadata) continue;
    const std::string text = value.get<std::string>();
    if (key.size() > kLongestMetadata || text.size() > kLongestMetadata || !is_metadata_text(key) ||
        !is_metadata_text(text))
      continue;
    metadata.emplace(key, text);
  }
  return metadata;
}

/// Leaves what tinygltf is to read. It wants the bytes of buffers and images at once (which are brought in
/// where they are asked for, and no farther away than beside the file), and a view of every accessor of
/// indices, which may have none.
void prepare(Json& json) {
  for (const char* other :
       {"buffers", "images", "textures", "samplers", "materials", "cameras", "extensions", "extras"}) {
    json.erase(other);
  }
  Json& views = json["bufferViews"];
  if (!views.is_array()) views = Json::array();
  const std::size_t no_view = views.size();
  views.push_back({{"buffer", 0}, {"byteLength", 1}});
  if (!member(json, "accessors").is_array()) return;
  for (Json& accessor : json["accessors"]) {
    if (accessor.is_object() && !accessor.contains("bufferView")) accessor["bufferView"] = no_view;
  }
}

}  // namespace

GltfDocument read_gltf_document(const std::string& path, std::string_view bytes) {
  GltfDocument document;
  const Container container =
      bytes.starts_with("glTF") ? split_binary(path, bytes) : Container{bytes, std::nullopt, 2};
  document.version = static_cast<int>(container.version);
  if (container.version == 1) return document;
  Json json = parse_json(path, container.json);
  document.version = check_version(path, json);
  if (document.version == 1) return document;
  document.binary = container.binary;
  check_required_extensions(path, texts(member(json, "extensionsRequired")));
  document.notes = extension_notes(path, texts(member(json, "extensionsUsed")));
  document.buffers = read_buffers(path, member(json, "buffers"));
  document.materials = take_materials(json);
  document.is_own = member(member(json, "asset"), "generator") == "TVG";
  if (document.is_own) document.metadata = read_metadata(member(member(json, "asset"), "extras"));
  document.extras = collect_extras(json, document.is_own);
  prepare(json);
  std::string reason;
  if (!load_gltf_model(json.dump(), document.model, reason)) {
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    fail(path, fmt::format(": it cannot be read as what its suffix says: {}",
                           reason.substr(0, reason.find_last_not_of(' ') + 1)));
  }
  return document;
}

}  // namespace tvg::cli
