#include "attributes/attribute_grid_encode.hpp"

#include <algorithm>
#include <cmath>

namespace tvg {

namespace {

/// Where a vector meets the octahedron, unfolded.
void fold(std::span<const float> normal, const AttributeGrid& grid, std::int32_t* place) {
  const double x = normal[0], y = normal[1], z = normal[2];
  const double sum = std::abs(x) + std::abs(y) + std::abs(z);
  if (!(sum > 0)) {
    place[0] = place[1] = grid.none();
    return;
  }
  const std::int32_t centre = grid.largest() / 2;
  const auto nearest = [&](double n) {
    return static_cast<std::int32_t>(std::floor(n / sum * centre + 0.5));
  };
  const std::int32_t j = nearest(y);
  const std::int32_t k = std::clamp(nearest(z), std::abs(j) - centre, centre - std::abs(j));
  if (x >= 0) {
    place[0] = centre + j;
    place[1] = centre + k;
  } else {
    place[0] = centre + (j < 0 ? std::abs(k) - centre : centre - std::abs(k));
    place[1] = centre + (k < 0 ? std::abs(j) - centre : centre - std::abs(j));
  }
}

}  // namespace

AttributeGrid grid_over(const Attribute& attribute) {
  AttributeGrid grid{attribute.kind, attribute.components, attribute.bits, {}, 0};
  if (!grid.stepped() || attribute.values.empty()) return grid;
  std::array<float, kMaxAttributeComponents> low{}, high{};
  for (std::size_t i = 0; i < attribute.values.size(); ++i) {
    const std::size_t c = i % grid.components;
    const float x = attribute.values[i];
    low[c] = i < grid.components ? x : std::min(low[c], x);
    high[c] = i < grid.components ? x : std::max(high[c], x);
  }
  const auto all = [&](const auto& test) {
    return std::all_of(attribute.values.begin(), attribute.values.end(), test);
  };
  if (grid.kind == AttributeKind::kColour && all([](float x) { return x >= 0 && x <= 1; })) {
    grid.range = 1;
    return grid;
  }
  for (std::size_t c = 0; c < grid.components; ++c) {
    grid.origin[c] = low[c] + 0.0f;
    grid.range = std::max(grid.range, static_cast<double>(high[c]) - low[c]);
  }
  return grid;
}

std::vector<std::int32_t> integers_of(const Attribute& attribute, const AttributeGrid& grid) {
  const std::size_t count = attribute.value_count();
  std::vector<std::int32_t> integers(count * grid.integers());
  if (grid.octahedral()) {
    for (std::size_t i = 0; i < count; ++i)
      fold(std::span(attribute.values).subspan(3 * i, 3), grid, &integers[2 * i]);
    return integers;
  }
  const double largest = grid.stepped() ? grid.largest() : 0;
  for (std::size_t i = 0; i < integers.size(); ++i) {
    const float x = attribute.values[i];
    if (!grid.stepped()) {
      integers[i] = ordered_integer(x);
    } else if (grid.range > 0) {
      const double place = (static_cast<double>(x) - grid.origin[i % grid.components]) / grid.range * largest;
      integers[i] = static_cast<std::int32_t>(std::clamp(std::floor(place + 0.5), 0.0, largest));
    }
  }
  return integers;
}

}  // namespace tvg
