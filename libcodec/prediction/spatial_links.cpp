#include "prediction/spatial_links.hpp"

#include "base/allocation.hpp"

#include <algorithm>

namespace tvg {

namespace {

/// The coordinate as a number whose order is the same, without a sign.
std::uint32_t offset(std::int32_t coordinate) {
  return static_cast<std::uint32_t>(coordinate) ^ 0x80000000u;
}

/// Morton's order: by the coordinate in which the two differ in the highest bit, of several the first.
bool before_on_curve(const ShapePoint& a, const ShapePoint& b) {
  std::size_t axis = 0;
  std::uint32_t highest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t differ = offset(a[k]) ^ offset(b[k]);
    if (highest < differ && highest < (highest ^ differ)) axis = k, highest = differ;
  }
  return a[axis] < b[axis];
}

}  // namespace

bool SpatialLinks::find(std::span<const Face> faces, std::span<const ShapePoint> shape) {
  if (!try_resize(curve_, shape.size()) || !try_resize(root_, shape.size())) return false;
  const auto count = static_cast<std::uint32_t>(shape.size());
  for (std::uint32_t v = 0; v < count; ++v) curve_[v] = root_[v] = v;
  for (const Face& face : faces) {
    for (const std::size_t i : {1, 2}) {
      const std::uint32_t a = root_of(face[0]), b = root_of(face[i]);
      root_[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::uint32_t v = 0; v < count; ++v) root_[v] = root_of(v);
  std::sort(curve_.begin(), curve_.end(), [shape](std::uint32_t a, std::uint32_t b) {
    return before_on_curve(shape[a], shape[b]) || (shape[a] == shape[b] && a < b);
  });
  return true;
}

std::uint32_t SpatialLinks::root_of(std::uint32_t v) {
  while (root_[v] != v) v = root_[v] = root_[root_[v]];
  return v;
}

}  // namespace tvg
