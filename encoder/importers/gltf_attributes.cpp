#include "encoder/importers/gltf_attributes.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/scene_attributes.hpp"

#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace tvg::cli {

namespace {

struct Meaning {
  AttributeKind kind = AttributeKind::kGeneric;
  std::size_t least_width = 1;
  std::size_t most_width = kMaxAttributeComponents;
  bool is_normalized = false;  ///< whatever the accessor says
};

/// What is kept of a primitive under a name; nothing of what makes up its motion and shape.
std::optional<Meaning> meaning_of(const std::string& name) {
  if (name.starts_with("TEXCOORD_")) return Meaning{AttributeKind::kTexcoord, 2, 2, false};
  if (name.starts_with("COLOR_")) return Meaning{AttributeKind::kColour, 3, 4, true};
  if (name == "NORMAL") return Meaning{AttributeKind::kNormal, 3, 3, true};
  if (name.starts_with('_')) return Meaning{};
  return std::nullopt;
}

class AttributeReader {
 public:
  AttributeReader(const std::string& name, const std::string& primitive, GltfAccessors& accessors,
                  ScenePart& part)
      : name_(name), what_(fmt::format("{}, {}", primitive, name)), accessors_(accessors), part_(part) {}

  void read(int accessor, const Meaning& meaning) {
    const std::uint64_t count = accessors_.count(accessor, what_);
    if (count != part_.positions.size())
      return leave_out(fmt::format("is for {} vertices of {}", count, part_.positions.size()));
    const std::size_t width = accessors_.width(accessor, what_);
    if (width < meaning.least_width || width > meaning.most_width)
      return leave_out(fmt::format("has {} components", width));
    Attribute attribute = empty_attribute(plain_name(name_), meaning.kind, static_cast<std::uint32_t>(width));
    const std::vector<double> values = accessors_.read(accessor, width, what_, meaning.is_normalized);
    attribute.values.reserve(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool points_down = meaning.kind == AttributeKind::kTexcoord && i % 2 == 1;
      attribute.values.push_back(static_cast<float>(points_down ? 1 - values[i] : values[i]));
      if (!std::isfinite(attribute.values.back()))
        return leave_out(fmt::format("of vertex {} is no finite number", i / width));
    }
    part_.attributes.push_back(std::move(attribute));
  }

 private:
  void leave_out(const std::string& why) {
    part_.notes.push_back(fmt::format("{} {}: it is left out", what_, why));
  }

  const std::string& name_;
  std::string what_;
  GltfAccessors& accessors_;
  ScenePart& part_;
};

/// What a morph target moves beside the surface.
bool is_lost_in_target(const std::string& attribute) {
  return attribute.starts_with("TEXCOORD_") || attribute.starts_with("COLOR_");
}

}  // namespace

void read_gltf_attributes(const tinygltf::Primitive& primitive, const std::string& name,
                          GltfAccessors& accessors, ScenePart& part) {
  for (const auto& [attribute, accessor] : primitive.attributes) {
    const std::optional<Meaning> meaning = meaning_of(attribute);
    if (!meaning) continue;
    try {
      AttributeReader(attribute, name, accessors, part).read(accessor, *meaning);
    } catch (const ImportError& error) {
      part.notes.push_back(fmt::format("{}: it is left out", error.what()));
    }
  }
  if (primitive.attributes.contains("TANGENT"))
    part.notes.emplace_back("tangents are left to the player, which makes them from normals and TEXCOORD");
  for (const std::map<std::string, int>& target : primitive.targets) {
    for (const auto& [attribute, accessor] : target) {
      if (is_lost_in_target(attribute))
        part.notes.push_back(fmt::format("what morph targets do to {} is left out", attribute));
    }
  }
}

}  // namespace tvg::cli
