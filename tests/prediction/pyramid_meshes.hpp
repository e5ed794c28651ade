#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <tvg/types.hpp>

// Meshes with a reference shape, for the tests of the pyramid: the same on every machine.
namespace tvg::test {

struct ShapedMesh {
  Mesh mesh;
  std::vector<std::array<std::int32_t, 3>> shape;

  std::uint32_t add(const std::array<std::int32_t, 3>& point) {
    shape.push_back(point);
    return mesh.vertex_count++;
  }
};

/// Small numbers without a pattern. Several in one expression are taken in braces, which have an order.
class Noise {
 public:
  std::int32_t below(std::uint32_t bound) {
    state_ = state_ * 1664525u + 1013904223u;
    return static_cast<std::int32_t>((state_ >> 8) % bound);
  }

 private:
  std::uint32_t state_ = 1;
};

/// A curved sheet of side * side vertices with noise; `at` moves it.
inline void add_sheet(ShapedMesh& to, std::uint32_t side, std::int32_t at, Noise& noise) {
  const std::uint32_t first = to.mesh.vertex_count;
  const auto middle = static_cast<std::int32_t>(side / 2);
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::int32_t x = static_cast<std::int32_t>(i) - middle, y = static_cast<std::int32_t>(j) - middle;
      to.add(
          {at + 16 * x + noise.below(9), 16 * y + noise.below(9), (x * x + 2 * y * y) / 2 + noise.below(9)});
    }
  }
  for (std::uint32_t i = 0; i + 1 < side; ++i) {
    for (std::uint32_t j = 0; j + 1 < side; ++j) {
      const std::uint32_t a = first + i * side + j;
      to.mesh.faces.push_back({a, a + side, a + 1});
      to.mesh.faces.push_back({a + 1, a + side, a + side + 1});
    }
  }
}

inline ShapedMesh sheet(std::uint32_t side) {
  ShapedMesh made;
  Noise noise;
  add_sheet(made, side, 0, noise);
  return made;
}

/// Triangles that share no vertex.
inline ShapedMesh soup(std::uint32_t triangles) {
  ShapedMesh made;
  Noise noise;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const std::int32_t x = noise.below(4000), y = noise.below(4000), z = noise.below(4000);
    const std::uint32_t a = made.add({x, y, z});
    made.add({x + noise.below(50), y, z});
    made.add({x, y + noise.below(50), z + 1});
    made.mesh.faces.push_back({a, a + 1, a + 2});
  }
  return made;
}

/// The sheet with its own copy of each corner in each face.
inline ShapedMesh torn_sheet(std::uint32_t side) {
  const ShapedMesh whole = sheet(side);
  ShapedMesh made;
  for (const Face& face : whole.mesh.faces) {
    const std::uint32_t a = made.mesh.vertex_count;
    for (const std::uint32_t v : face) made.add(whole.shape[v]);
    made.mesh.faces.push_back({a, a + 1, a + 2});
  }
  return made;
}

/// A vertex around which `rim` triangles lie; closed where each shares an edge with the next, else only the
/// vertex.
inline ShapedMesh hub(std::uint32_t rim, bool closed) {
  ShapedMesh made;
  Noise noise;
  made.add({0, 0, 5000});
  for (std::uint32_t i = 0; i < rim * (closed ? 1 : 2); ++i)
    made.add({noise.below(100000), noise.below(100000), noise.below(100)});
  for (std::uint32_t i = 0; i < rim; ++i) {
    if (closed) made.mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % rim});
    if (!closed) made.mesh.faces.push_back({0, 1 + 2 * i, 2 + 2 * i});
  }
  return made;
}

/// Sheets, a hub, a soup, duplicates, degenerate faces and vertices without a face, in one mesh.
inline ShapedMesh medley() {
  ShapedMesh made = hub(200, true);
  Noise noise;
  add_sheet(made, 20, 3000, noise);
  add_sheet(made, 3, -900, noise);
  const auto append = [&made](const ShapedMesh& more) {
    const std::uint32_t first = made.mesh.vertex_count;
    for (const auto& p : more.shape) made.add({p[0], p[1], p[2] - 7000});
    for (const Face& f : more.mesh.faces)
      made.mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  };
  append(soup(40));
  append(torn_sheet(7));
  for (int i = 0; i < 25; ++i) made.add({noise.below(9000), noise.below(9000), noise.below(9000)});
  made.mesh.faces.push_back({5, 5, 5});
  made.mesh.faces.push_back({7, 7, 300});
  made.mesh.faces.push_back({0, 400, 500});
  made.mesh.faces.push_back({400, 0, 500});
  return made;
}

}  // namespace tvg::test
