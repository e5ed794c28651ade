#include "decoder/exporters/gltf_material_repair.hpp"

#include <algorithm>
#include <string>

namespace tvg::cli {

using nlohmann::json;

namespace {

constexpr const char* kStrength = "KHR_materials_emissive_strength";

/// Removes a member that `fits` does not accept.
template <typename Fits>
void keep_where(json& object, const char* name, const Fits& fits) {
  if (const auto found = object.find(name); found != object.end() && !fits(*found)) object.erase(found);
}

/// A list of `count` numbers.
bool are_numbers(const json& list, std::size_t count) {
  return list.is_array() && list.size() == count &&
         std::all_of(list.begin(), list.end(), [](const json& value) { return value.is_number(); });
}

bool is_inside(double value) {
  return value >= 0 && value <= 1;
}

void clamp_number(json& object, const char* name) {
  keep_where(object, name, [](const json& value) { return value.is_number(); });
  if (!object.contains(name) || is_inside(object[name].get<double>())) return;
  object[name] = std::clamp(object[name].get<double>(), 0.0, 1.0);
}

void clamp_colour(json& object, const char* name, std::size_t count) {
  keep_where(object, name, [count](const json& value) { return are_numbers(value, count); });
  if (!object.contains(name)) return;
  for (json& value : object[name]) {
    if (!is_inside(value.get<double>())) value = std::clamp(value.get<double>(), 0.0, 1.0);
  }
}

/// Light above 1 becomes light of 1 and a strength.
void keep_strength(json& material) {
  const auto factor = material.find("emissiveFactor");
  if (factor == material.end() || !are_numbers(*factor, 3)) return;
  double most = 0;
  for (const json& value : *factor) most = std::max(most, value.get<double>());
  if (most <= 1 || (material.contains("extensions") && material["extensions"].contains(kStrength))) return;
  for (json& value : *factor) value = value.get<double>() / most;
  material["extensions"][kStrength] = {{"emissiveStrength", most}};
}

/// What names a texture is an object with its number.
void repair_texture_infos(json& object) {
  for (auto entry = object.begin(); entry != object.end();) {
    const bool is_texture = entry.key().ends_with("Texture");
    const bool fits = !is_texture || (entry->is_object() && entry->contains("index"));
    if (!fits) {
      entry = object.erase(entry);
      continue;
    }
    if (is_texture) {
      for (const char* name : {"scale", "strength"})
        keep_where(*entry, name, [](const json& value) { return value.is_number(); });
    }
    ++entry;
  }
}

/// Extensions are objects, of a material as of the textures that it names.
void repair_extensions(json& object) {
  if (!object.is_object()) return;
  keep_where(object, "extensions", [](const json& value) { return value.is_object(); });
  if (!object.contains("extensions")) return;
  json& extensions = object["extensions"];
  for (auto entry = extensions.begin(); entry != extensions.end();)
    entry = entry->is_object() ? std::next(entry) : extensions.erase(entry);
  if (extensions.empty()) object.erase("extensions");
}

}  // namespace

void repair_gltf_material(json& material) {
  if (!material.is_object()) material = json::object();
  const auto is_object = [](const json& value) { return value.is_object(); };
  repair_extensions(material);
  keep_strength(material);
  clamp_colour(material, "emissiveFactor", 3);
  repair_texture_infos(material);
  keep_where(material, "pbrMetallicRoughness", is_object);
  keep_where(material, "doubleSided", [](const json& value) { return value.is_boolean(); });
  keep_where(material, "alphaMode",
             [](const json& value) { return value == "OPAQUE" || value == "MASK" || value == "BLEND"; });
  // It is of MASK alone.
  keep_where(material, "alphaCutoff", [&material](const json& value) {
    return value.is_number() && value.get<double>() >= 0 && material.value("alphaMode", "") == "MASK";
  });
  for (json& value : material) repair_extensions(value);
  if (!material.contains("pbrMetallicRoughness")) return;
  json& surface = material["pbrMetallicRoughness"];
  clamp_colour(surface, "baseColorFactor", 4);
  clamp_number(surface, "metallicFactor");
  clamp_number(surface, "roughnessFactor");
  repair_texture_infos(surface);
  for (json& value : surface) repair_extensions(value);
}

}  // namespace tvg::cli
