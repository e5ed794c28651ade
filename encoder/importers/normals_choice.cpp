#include "encoder/importers/normals_choice.hpp"

#include <cmath>
#include <vector>

#include <tvg/normals.hpp>

namespace tvg::cli {

namespace {

constexpr double kCosineOfOneDegree = 0.99984769515639124;

/// Whether two vectors look the same way; one of length 0 looks any way.
bool look_alike(const float* a, const float* b) {
  double product = 0, square_a = 0, square_b = 0;
  for (int axis = 0; axis < 3; ++axis) {
    product += double{a[axis]} * double{b[axis]};
    square_a += double{a[axis]} * double{a[axis]};
    square_b += double{b[axis]} * double{b[axis]};
  }
  if (square_a == 0 || square_b == 0) return true;
  return product >= kCosineOfOneDegree * std::sqrt(square_a) * std::sqrt(square_b);
}

}  // namespace

bool follow_from_faces(const Mesh& mesh, std::span<const float> positions, const Attribute& normals) {
  std::vector<float> computed(positions.size());
  vertex_normals(mesh.faces, positions, computed);
  if (normals.domain == AttributeDomain::kVertex) {
    for (std::size_t vertex = 0; vertex < mesh.vertex_count; ++vertex) {
      if (!look_alike(&normals.values[3 * vertex], &computed[3 * vertex])) return false;
    }
    return true;
  }
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t value = normals.corners[3 * face + corner];
      const std::size_t vertex = mesh.faces[face][corner];
      if (!look_alike(&normals.values[3 * value], &computed[3 * vertex])) return false;
    }
  }
  return true;
}

}  // namespace tvg::cli
