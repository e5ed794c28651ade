#include <algorithm>
#include <cmath>
#include <cstddef>

#include <tvg/normals.hpp>

namespace tvg {

void vertex_normals(std::span<const Face> faces, std::span<const float> positions, std::span<float> normals) {
  std::fill(normals.begin(), normals.end(), 0.0f);
  const float* const from = positions.data();
  float* const to = normals.data();
  for (const Face& face : faces) {
    const float* const a = from + 3 * std::size_t{face[0]};
    const float* const b = from + 3 * std::size_t{face[1]};
    const float* const c = from + 3 * std::size_t{face[2]};
    const float u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const float v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    // The length of the cross product is twice the area, so that the sum is weighted as it should be.
    const float n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    for (const std::uint32_t corner : face) {
      float* const target = to + 3 * std::size_t{corner};
      for (int axis = 0; axis < 3; ++axis) target[axis] += n[axis];
    }
  }
  for (std::size_t i = 0; i + 2 < normals.size(); i += 3) {
    // In double, because squares of small or large float32 leave its range.
    const double x = to[i], y = to[i + 1], z = to[i + 2];
    const double length = std::sqrt(x * x + y * y + z * z);
    const double scale = length > 0 && std::isfinite(length) ? 1 / length : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      to[i + axis] = scale == 0 ? 0.0f : static_cast<float>(to[i + axis] * scale);
    }
  }
}

}  // namespace tvg
