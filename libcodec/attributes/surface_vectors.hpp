#pragma once
#include "attributes/property_mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

// Vectors of binary64 numbers over a mesh's reference shape (format-spec §5.7.3). Every operation is rounded
// in the order that is written here.
namespace tvg {

using Vector = std::array<double, 3>;

inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline void add(Vector& sum, const Vector& a, double share) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] + share * a[i];
}
/// Of length 1; zero where there is no direction.
inline Vector unit(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 0)) return {0, 0, 0};
  return {a[0] / length, a[1] / length, a[2] / length};
}
/// How far apart, the axes summed.
inline double distance(const Vector& a, const Vector& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

/// Where a corner is in the reference shape, which the mesh has.
inline Vector place_of(const PropertyMesh& mesh, std::uint32_t corner) {
  const std::array<std::int32_t, 3>& index = mesh.shape->indices[mesh.faces[corner / 3][corner % 3]];
  return {static_cast<double>(index[0]), static_cast<double>(index[1]), static_cast<double>(index[2])};
}

}  // namespace tvg
