#include "encoder/importers/gltf_own_extras.hpp"

#include "encoder/importers/scene_attributes.hpp"

#include <algorithm>
#include <cmath>

namespace tvg::cli {

namespace {

using Value = tinygltf::Value;

std::string text_of(const Value& object, const char* name) {
  const Value& text = object.Get(name);
  return text.IsString() ? plain_name(text.Get<std::string>()) : std::string();
}

/// Whether triangles are the fan of one polygon around its first corner.
bool is_fan(std::span<const Face> triangles) {
  for (std::size_t i = 1; i < triangles.size(); ++i) {
    if (triangles[i][0] != triangles[0][0] || triangles[i][1] != triangles[i - 1][2]) return false;
  }
  return true;
}

/// Runs of faces with as many corners; nothing where they are not those of the triangles.
std::vector<Polygon> polygons_of(const Value& runs, const std::vector<Face>& faces) {
  std::vector<Polygon> polygons;
  std::size_t triangle = 0;
  for (std::size_t run = 0; run + 1 < runs.ArrayLen(); run += 2) {
    const Value& count = runs.Get(static_cast<int>(run));
    const Value& corners = runs.Get(static_cast<int>(run + 1));
    if (!count.IsInt() || !corners.IsInt() || count.Get<int>() < 0 || corners.Get<int>() < 3) return {};
    const auto triangles = static_cast<std::size_t>(corners.Get<int>()) - 2;
    for (int i = 0; i < count.Get<int>(); ++i) {
      if (triangles > faces.size() - triangle) return {};
      if (!is_fan(std::span(faces).subspan(triangle, triangles))) return {};
      if (triangles > 1) polygons.push_back({triangle, static_cast<std::uint32_t>(triangles + 2)});
      triangle += triangles;
    }
  }
  return triangle == faces.size() ? polygons : std::vector<Polygon>();
}

/// One to four numbers; none where they are others.
std::vector<float> numbers_of(const Value& list) {
  std::vector<float> numbers;
  if (list.ArrayLen() > kMaxAttributeComponents) return numbers;
  for (std::size_t i = 0; i < list.ArrayLen(); ++i) {
    const Value& number = list.Get(static_cast<int>(i));
    const auto value = number.IsNumber() ? static_cast<float>(number.GetNumberAsDouble()) : NAN;
    if (!std::isfinite(value)) return {};
    numbers.push_back(value);
  }
  return numbers;
}

/// Attributes of one kind are told apart by their names, so that a name is given once.
void name_attributes(const Value& names, std::vector<Attribute>& attributes) {
  for (Attribute& attribute : attributes) {
    if (!names.Has(attribute.name)) continue;
    const std::string name = text_of(names, attribute.name.c_str());
    const bool is_taken = std::ranges::any_of(attributes, [&](const Attribute& other) {
      return &other != &attribute && other.kind == attribute.kind && other.name == name;
    });
    if (!is_taken) attribute.name = name;
  }
}

}  // namespace

void read_own_extras(const Value& extras, ScenePart& part) {
  part.names = Part();
  if (!extras.IsObject()) return;
  part.names = Part{text_of(extras, "object"), text_of(extras, "group"), ""};
  part.polygons = polygons_of(extras.Get("polygons"), part.faces);
  const Value& values = extras.Get("values");
  for (const std::string& name : values.Keys()) {
    std::vector<float> numbers = numbers_of(values.Get(name));
    if (!numbers.empty()) part.values.emplace(plain_name(name), std::move(numbers));
  }
  name_attributes(extras.Get("names"), part.attributes);
}

}  // namespace tvg::cli
