#include "encoder/importers/corner_values.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <tvg/geometry.hpp>

namespace tvg::cli {

namespace {

constexpr std::uint32_t kNone = CornerValues::kNone;

/// Gives corners without a value one of zeros.
std::size_t fill_missing(Attribute& attribute) {
  const auto missing =
      static_cast<std::size_t>(std::count(attribute.corners.begin(), attribute.corners.end(), kNone));
  if (missing == 0) return 0;
  const auto none = static_cast<std::uint32_t>(attribute.value_count());
  attribute.values.insert(attribute.values.end(), attribute.components, 0.0F);
  std::replace(attribute.corners.begin(), attribute.corners.end(), kNone, none);
  return missing;
}

void leave_out_unused(Attribute& attribute) {
  const std::size_t components = attribute.components;
  std::vector<std::uint32_t> number(attribute.value_count(), kNone);
  for (const std::uint32_t value : attribute.corners) number[value] = 0;
  std::uint32_t kept = 0;
  for (std::size_t value = 0; value < number.size(); ++value) {
    if (number[value] == kNone) continue;
    std::copy_n(attribute.values.begin() + static_cast<std::ptrdiff_t>(value * components), components,
                attribute.values.begin() + static_cast<std::ptrdiff_t>(kept * components));
    number[value] = kept++;
  }
  attribute.values.resize(kept * components);
  for (std::uint32_t& value : attribute.corners) value = number[value];
}

/// The value of each vertex, where its corners agree; empty where those of one do not.
std::vector<std::uint32_t> values_of_vertices(const Attribute& attribute, std::span<const Face> faces,
                                              std::size_t vertex_count) {
  const std::size_t components = attribute.components;
  const auto at = [&](std::uint32_t value) {
    return attribute.values.begin() + static_cast<std::ptrdiff_t>(value * components);
  };
  std::vector<std::uint32_t> of_vertex(vertex_count, kNone);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t value = attribute.corners[3 * face + corner];
      std::uint32_t& known = of_vertex[faces[face][corner]];
      if (known == kNone) known = value;
      if (known != value &&
          !std::equal(at(known), at(known) + static_cast<std::ptrdiff_t>(components), at(value)))
        return {};
    }
  }
  return of_vertex;
}

}  // namespace

std::size_t settle_corners(Attribute& attribute, std::span<const Face> faces, std::size_t vertex_count) {
  const std::size_t missing = fill_missing(attribute);
  const std::vector<std::uint32_t> of_vertex = values_of_vertices(attribute, faces, vertex_count);
  if (of_vertex.empty()) {
    attribute.domain = AttributeDomain::kCorner;
    leave_out_unused(attribute);
    return missing;
  }
  const std::size_t components = attribute.components;
  std::vector<float> values(vertex_count * components, 0.0F);
  for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
    if (of_vertex[vertex] == kNone) continue;
    std::copy_n(attribute.values.begin() + static_cast<std::ptrdiff_t>(of_vertex[vertex] * components),
                components, values.begin() + static_cast<std::ptrdiff_t>(vertex * components));
  }
  attribute.domain = AttributeDomain::kVertex;
  attribute.values = std::move(values);
  attribute.corners.clear();
  return missing;
}

void share_values(Attribute& attribute, std::span<const Face> faces) {
  const std::size_t components = attribute.components;
  const auto vertex_of = [&](std::uint32_t corner) { return faces[corner / 3][corner % 3]; };
  const auto value_of = [&](std::uint32_t corner) {
    return attribute.values.data() + std::size_t{attribute.corners[corner]} * components;
  };
  const auto is_none = [&](std::uint32_t corner) { return attribute.corners[corner] == kNone; };
  const auto hash = [&](std::uint32_t corner) {
    std::uint64_t mixed = mix_hash(0, vertex_of(corner));
    for (std::size_t i = 0; i < components && !is_none(corner); ++i)
      mixed = mix_hash(mixed, std::bit_cast<std::uint32_t>(value_of(corner)[i] + 0.0F));
    return mixed;
  };
  const auto equal = [&](std::uint32_t a, std::uint32_t b) {
    if (vertex_of(a) != vertex_of(b) || is_none(a) || is_none(b))
      return vertex_of(a) == vertex_of(b) && is_none(a) && is_none(b);
    return std::equal(value_of(a), value_of(a) + components, value_of(b));
  };
  const Weld weld = weld_points(attribute.corners.size(), hash, equal);
  std::vector<std::uint32_t> shared(attribute.corners.size());
  for (std::size_t corner = 0; corner < shared.size(); ++corner)
    shared[corner] = attribute.corners[weld.first_point[weld.vertex_of_point[corner]]];
  attribute.corners = std::move(shared);
}

std::size_t clear_non_finite(std::span<float> values) {
  std::size_t cleared = 0;
  for (float& value : values) {
    if (std::isfinite(value)) continue;
    value = 0;
    ++cleared;
  }
  return cleared;
}

}  // namespace tvg::cli
