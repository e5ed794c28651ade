#include "encoder/importers/normal_shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tvg::cli {

namespace {

using Vector = std::array<double, 3>;

constexpr double kCosineOfOneDegree = 0.99984769515639124;

Vector between(std::span<const float> positions, std::uint32_t from, std::uint32_t to) {
  Vector result;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] =
        double{positions[3 * std::size_t{to} + axis]} - double{positions[3 * std::size_t{from} + axis]};
  return result;
}

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

void add(Vector& sum, const Vector& vector, double weight) {
  for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += weight * vector[axis];
}

Vector area_vector(std::span<const float> positions, const Face& face) {
  return cross(between(positions, face[0], face[1]), between(positions, face[0], face[2]));
}

/// Whether the normal of every corner looks as `expected(face, corner)` does; one without length looks any
/// way.
template <class Expected>
bool all_look_like(std::span<const Face> faces, const Attribute& normals, Expected&& expected) {
  for (std::size_t face = 0; face < faces.size(); ++face) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t value =
          normals.corners.empty() ? faces[face][corner] : normals.corners[3 * face + corner];
      const float* const given = &normals.values[3 * value];
      const Vector normal = {double{given[0]}, double{given[1]}, double{given[2]}};
      const Vector& wanted = expected(face, corner);
      const double lengths = std::sqrt(dot(normal, normal)) * std::sqrt(dot(wanted, wanted));
      if (dot(normal, wanted) < kCosineOfOneDegree * lengths) return false;
    }
  }
  return true;
}

/// The sums of the faces' normals around each vertex, weighted by `weight(face, corner, area_vector)`.
template <class Weight>
std::vector<Vector> sums_at_vertices(std::span<const Face> faces, std::span<const float> positions,
                                     Weight&& weight) {
  std::vector<Vector> sums(positions.size() / 3, Vector{});
  for (const Face& face : faces) {
    const Vector area = area_vector(positions, face);
    for (std::size_t corner = 0; corner < 3; ++corner)
      add(sums[face[corner]], area, weight(face, corner, area));
  }
  return sums;
}

/// An angle's share of a unit normal, given the normal times twice the area.
double angle_weight(std::span<const float> positions, const Face& face, std::size_t corner,
                    const Vector& area) {
  const double size = std::sqrt(dot(area, area));
  if (size == 0) return 0;
  const Vector next = between(positions, face[corner], face[(corner + 1) % 3]);
  const Vector last = between(positions, face[corner], face[(corner + 2) % 3]);
  return std::atan2(size, dot(next, last)) / size;
}

/// The normals of the faces as the file had them, for each triangle: a polygon is one.
std::vector<Vector> flat_normals(std::span<const Face> faces, std::span<const Polygon> polygons,
                                 std::span<const float> positions) {
  std::vector<Vector> normals(faces.size());
  for (std::size_t face = 0; face < faces.size(); ++face) normals[face] = area_vector(positions, faces[face]);
  for (const Polygon& polygon : polygons) {
    Vector sum{};
    const std::size_t end = polygon.first_triangle + polygon.corners - 2;
    for (std::size_t face = polygon.first_triangle; face < end; ++face) add(sum, normals[face], 1);
    std::fill(normals.begin() + static_cast<std::ptrdiff_t>(polygon.first_triangle),
              normals.begin() + static_cast<std::ptrdiff_t>(end), sum);
  }
  return normals;
}

}  // namespace

std::optional<NormalShading> find_shading(std::span<const Face> faces, std::span<const Polygon> polygons,
                                          std::span<const float> positions, const Attribute& normals) {
  const auto is_smooth = [&](const std::vector<Vector>& sums) {
    return all_look_like(faces, normals, [&](std::size_t face, std::size_t corner) -> const Vector& {
      return sums[faces[face][corner]];
    });
  };
  const auto by_area = [](const Face&, std::size_t, const Vector&) { return 1.0; };
  const auto by_angle = [&](const Face& face, std::size_t corner, const Vector& area) {
    return angle_weight(positions, face, corner, area);
  };
  if (is_smooth(sums_at_vertices(faces, positions, by_area))) return NormalShading::kSmooth;
  if (is_smooth(sums_at_vertices(faces, positions, by_angle))) return NormalShading::kSmooth;
  const std::vector<Vector> flat = flat_normals(faces, polygons, positions);
  if (all_look_like(faces, normals,
                    [&](std::size_t face, std::size_t) -> const Vector& { return flat[face]; }))
    return NormalShading::kFlat;
  return std::nullopt;
}

}  // namespace tvg::cli
