#include "encoder/importers/scene_attributes.hpp"

#include <algorithm>
#include <bit>

#include <tvg/geometry.hpp>

namespace tvg::cli {

namespace {

/// What a vertex has that has no value.
float default_value(AttributeKind kind, std::uint32_t component) {
  return kind == AttributeKind::kColour || (kind == AttributeKind::kGeneric && component == 3) ? 1.0F : 0.0F;
}

void add_defaults(Attribute& attribute, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    for (std::uint32_t component = 0; component < attribute.components; ++component)
      attribute.values.push_back(default_value(attribute.kind, component));
  }
}

/// Appends values that have fewer components, or as many.
void add_values(Attribute& attribute, const Attribute& more) {
  for (std::size_t i = 0; i < more.value_count(); ++i) {
    for (std::uint32_t component = 0; component < attribute.components; ++component) {
      attribute.values.push_back(component < more.components ? more.values[i * more.components + component]
                                                             : default_value(attribute.kind, component));
    }
  }
}

void widen(Attribute& attribute, std::uint32_t components) {
  if (attribute.components >= components) return;
  const Attribute narrow = std::move(attribute);
  attribute = empty_attribute(narrow.name, narrow.kind, components);
  add_values(attribute, narrow);
}

}  // namespace

Attribute empty_attribute(std::string name, AttributeKind kind, std::uint32_t components) {
  Attribute attribute;
  attribute.name = std::move(name);
  attribute.kind = kind;
  attribute.components = components;
  return attribute;
}

Attribute* AttributeGatherer::find(const Attribute& like) {
  for (Attribute& attribute : gathered_) {
    if (attribute.kind == like.kind && attribute.name == like.name) return &attribute;
  }
  if (gathered_.size() == kMaxAttributes) {
    ++left_out_;
    return nullptr;
  }
  Attribute& added = gathered_.emplace_back(empty_attribute(like.name, like.kind, like.components));
  add_defaults(added, vertices_);
  return &added;
}

bool AttributeGatherer::take(std::size_t vertices, std::span<const Attribute> attributes) {
  const std::uint64_t most_attributes =
      std::min<std::uint64_t>(kMaxAttributes, gathered_.size() + attributes.size());
  // Of 2^32 vertices at most, so that nothing overflows.
  if (most_attributes * kMaxAttributeComponents * (vertices_ + vertices) > most_) return false;
  for (const Attribute& more : attributes) {
    Attribute* const attribute = find(more);
    if (attribute == nullptr) continue;
    widen(*attribute, more.components);
    // A name that comes twice counts once.
    if (attribute->value_count() == vertices_) add_values(*attribute, more);
  }
  vertices_ += vertices;
  for (Attribute& attribute : gathered_) add_defaults(attribute, vertices_ - attribute.value_count());
  return true;
}

Attribute with_joined_vertices(const Attribute& of_vertices, std::span<const Face> faces,
                               std::span<const std::uint32_t> vertex_of, std::uint32_t vertex_count) {
  const std::size_t width = of_vertices.components;
  const std::vector<float>& values = of_vertices.values;
  // Those that faces use come first, so that others cannot make a seam.
  std::vector<std::uint32_t> order;
  std::vector<char> is_used(vertex_of.size(), 0);
  for (const Face& face : faces) {
    for (const std::uint32_t vertex : face) {
      if (is_used[vertex] == 0) order.push_back(vertex);
      is_used[vertex] = 1;
    }
  }
  const auto hash = [&](std::uint32_t point) {
    std::uint64_t mixed = mix_hash(0, vertex_of[order[point]]);
    for (std::size_t i = 0; i < width; ++i)
      mixed = mix_hash(mixed, std::bit_cast<std::uint32_t>(values[width * order[point] + i] + 0.0F));
    return mixed;
  };
  const auto equal = [&](std::uint32_t a, std::uint32_t b) {
    const auto* const at = values.data();
    return vertex_of[order[a]] == vertex_of[order[b]] &&
           std::equal(at + width * order[a], at + width * (order[a] + std::size_t{1}), at + width * order[b]);
  };
  const Weld weld = weld_points(order.size(), hash, equal);

  constexpr std::uint32_t kNone = UINT32_MAX;
  Attribute joined = empty_attribute(of_vertices.name, of_vertices.kind, of_vertices.components);
  std::vector<std::uint32_t> first_of(vertex_count, kNone);  // [vertex joined], the vertex whose value it has
  bool has_seams = false;
  for (const std::uint32_t point : weld.first_point) {
    std::uint32_t& first = first_of[vertex_of[order[point]]];
    has_seams = has_seams || first != kNone;
    if (first == kNone) first = order[point];
  }
  const auto add_value = [&](std::uint32_t vertex) {
    joined.values.insert(joined.values.end(), values.begin() + static_cast<std::ptrdiff_t>(width * vertex),
                         values.begin() + static_cast<std::ptrdiff_t>(width * (vertex + std::size_t{1})));
  };
  if (has_seams) {
    joined.domain = AttributeDomain::kCorner;
    for (const std::uint32_t point : weld.first_point) add_value(order[point]);
    std::vector<std::uint32_t> value_of(vertex_of.size(), 0);
    for (std::uint32_t point = 0; point < order.size(); ++point)
      value_of[order[point]] = weld.vertex_of_point[point];
    for (const Face& face : faces) {
      for (const std::uint32_t vertex : face) joined.corners.push_back(value_of[vertex]);
    }
    return joined;
  }
  for (std::uint32_t vertex = 0; vertex < vertex_of.size(); ++vertex) {
    if (first_of[vertex_of[vertex]] == kNone) first_of[vertex_of[vertex]] = vertex;
  }
  for (const std::uint32_t vertex : first_of) add_value(vertex);
  return joined;
}

std::string plain_name(std::string name, std::size_t longest) {
  if (name.size() > longest) {
    // Not through a letter of several bytes.
    while (longest > 0 && (name[longest] & 0xc0) == 0x80) --longest;
    name.resize(longest);
  }
  if (is_metadata_text(name)) return name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\0' || (c & 0x80) != 0; }, '_');
  return name;
}

}  // namespace tvg::cli
