#include "metrics/polygon_match.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace tvg {

namespace {

/// Edges from a vertex (the upper half) to the next, sorted.
using Outline = std::vector<std::uint64_t>;

std::uint64_t edge(std::uint64_t from, std::uint64_t to) {
  return from << 32 | to;
}

/// The edges of a polygon's triangles that no other of them has the other way round.
Outline outline_of(std::span<const Face> faces, const Polygon& polygon) {
  Outline edges, outline;
  for (const Face& face : faces.subspan(polygon.first_triangle, polygon.corners - 2)) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      edges.push_back(edge(face[corner], face[(corner + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  for (const std::uint64_t one : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), edge(one & UINT32_MAX, one >> 32)))
      outline.push_back(one);
  }
  return outline;
}

std::vector<Outline> outlines_of(std::span<const Face> faces, std::span<const Polygon> polygons) {
  std::vector<Outline> outlines;
  outlines.reserve(polygons.size());
  for (const Polygon& polygon : polygons) outlines.push_back(outline_of(faces, polygon));
  std::sort(outlines.begin(), outlines.end());
  return outlines;
}

}  // namespace

std::uint64_t unmatched_polygons(std::span<const Face> original_faces, std::span<const Polygon> original,
                                 std::span<const Face> decoded_faces, std::span<const Polygon> decoded) {
  const std::vector<Outline> left = outlines_of(original_faces, original);
  const std::vector<Outline> right = outlines_of(decoded_faces, decoded);
  std::vector<const Outline*> alone;
  const auto pointers = [](const std::vector<Outline>& outlines) {
    std::vector<const Outline*> result;
    result.reserve(outlines.size());
    for (const Outline& outline : outlines) result.push_back(&outline);
    return result;
  };
  const std::vector<const Outline*> a = pointers(left), b = pointers(right);
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(alone),
                                [](const Outline* x, const Outline* y) { return *x < *y; });
  return alone.size();
}

}  // namespace tvg
