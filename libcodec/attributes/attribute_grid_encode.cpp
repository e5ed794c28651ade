#include "attributes/attribute_grid_encode.hpp"

#include <algorithm>
#include <array>
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

AttributeGrid grid_over(AttributeGrid like, std::span<const AttributeValues> frames) {
  AttributeGrid grid = like;
  std::array<float, kMaxAttributeComponents> low{}, high{};
  bool any = false, share = true;
  for (const AttributeValues values : frames) {
    if (!grid.stepped() || values.empty()) continue;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t c = i % grid.components;
      const bool first = !any && i < grid.components;
      low[c] = first ? values[i] : std::min(low[c], values[i]);
      high[c] = first ? values[i] : std::max(high[c], values[i]);
      share = share && values[i] >= 0 && values[i] <= 1;
    }
    any = true;
  }
  if (!any) return grid;
  if (grid.kind == AttributeKind::kColour && share) {
    grid.range = 1;
    return grid;
  }
  for (std::size_t c = 0; c < grid.components; ++c) {
    grid.origin[c] = low[c] + 0.0f;
    grid.range = std::max(grid.range, static_cast<double>(high[c]) - low[c]);
  }
  return grid;
}

std::vector<std::int32_t> integers_of(AttributeValues values, const AttributeGrid& grid) {
  const std::size_t count = values.size() / grid.components;
  std::vector<std::int32_t> integers(count * grid.integers());
  if (grid.octahedral()) {
    for (std::size_t i = 0; i < count; ++i) fold(values.subspan(3 * i, 3), grid, &integers[2 * i]);
    return integers;
  }
  const double largest = grid.stepped() ? grid.largest() : 0;
  for (std::size_t i = 0; i < integers.size(); ++i) {
    const float x = values[i];
    if (!grid.stepped()) {
      integers[i] = ordered_integer(x);
    } else if (grid.range > 0) {
      const double place = (static_cast<double>(x) - grid.origin[i % grid.components]) / grid.range * largest;
      integers[i] = static_cast<std::int32_t>(std::clamp(std::floor(place + 0.5), 0.0, largest));
    }
  }
  return integers;
}

void write_steps(ByteWriter& writer, const AttributeGrid& grid) {
  if (!grid.stepped()) return;
  for (std::size_t c = 0; c < grid.components; ++c) writer.u32(bits_as<std::uint32_t>(grid.origin[c]));
  writer.f64(grid.range);
}

}  // namespace tvg
