#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <tvg/types.hpp>

// Small meshes of every sort, for tests.
namespace tvg::test {

/// A grid of columns x rows quads, each two triangles; wrapped round in one direction (a tube) or in both (a
/// torus).
inline Mesh grid(std::uint32_t columns, std::uint32_t rows, bool wrap_x = false, bool wrap_y = false) {
  const std::uint32_t width = wrap_x ? columns : columns + 1, height = wrap_y ? rows : rows + 1;
  Mesh mesh{width * height, {}};
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      const std::uint32_t x1 = (x + 1) % width, y1 = (y + 1) % height;
      const std::uint32_t a = y * width + x, b = y * width + x1, c = y1 * width + x1, d = y1 * width + x;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  }
  return mesh;
}

inline Mesh tetrahedron() {
  return {4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// A tube whose ends are closed by a fan.
inline Mesh closed_surface(std::uint32_t around, std::uint32_t along) {
  Mesh mesh = grid(around, along, true, false);
  const std::uint32_t bottom = mesh.vertex_count, top = bottom + 1, last = along * around;
  mesh.vertex_count += 2;
  for (std::uint32_t x = 0; x < around; ++x) {
    mesh.faces.push_back({bottom, (x + 1) % around, x});
    mesh.faces.push_back({top, last + x, last + (x + 1) % around});
  }
  return mesh;
}

/// Both meshes in one; they share no vertex.
inline Mesh joined(Mesh a, const Mesh& b) {
  for (Face face : b.faces) {
    for (std::uint32_t& v : face) v += a.vertex_count;
    a.faces.push_back(face);
  }
  a.vertex_count += b.vertex_count;
  return a;
}

/// Takes away each face with the given probability: holes, and vertices where the surface only touches
/// itself.
inline Mesh with_holes(Mesh mesh, double share, std::mt19937& random) {
  std::bernoulli_distribution drop(share);
  std::erase_if(mesh.faces, [&](const Face&) { return drop(random); });
  return mesh;
}

/// Turns round each face with the given probability.
inline Mesh with_flips(Mesh mesh, double share, std::mt19937& random) {
  std::bernoulli_distribution flip(share);
  for (Face& face : mesh.faces) {
    if (flip(random)) std::swap(face[0], face[1]);
  }
  return mesh;
}

/// Adds copies of random faces, as they are or turned round.
inline Mesh with_duplicates(Mesh mesh, std::size_t count, std::mt19937& random) {
  for (std::size_t i = 0; i < count && !mesh.faces.empty(); ++i) {
    Face face = mesh.faces[random() % mesh.faces.size()];
    if (random() % 2 == 0) std::swap(face[1], face[2]);
    mesh.faces.push_back(face);
  }
  return mesh;
}

/// Faces of any three vertices, equal ones allowed.
inline Mesh random_soup(std::uint32_t vertex_count, std::size_t face_count, std::mt19937& random) {
  Mesh mesh{vertex_count, std::vector<Face>(face_count)};
  for (Face& face : mesh.faces) {
    for (std::uint32_t& v : face) v = static_cast<std::uint32_t>(random() % vertex_count);
  }
  return mesh;
}

/// The same mesh with its vertices renumbered and its faces in another order, each from another corner.
inline Mesh shuffled(Mesh mesh, std::mt19937& random) {
  std::vector<std::uint32_t> index(mesh.vertex_count);
  std::iota(index.begin(), index.end(), 0u);
  std::shuffle(index.begin(), index.end(), random);
  std::shuffle(mesh.faces.begin(), mesh.faces.end(), random);
  for (Face& face : mesh.faces) {
    for (std::uint32_t& v : face) v = index[v];
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random() % 3), face.end());
  }
  return mesh;
}

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

/// One of everything: what a codec has to carry.
inline std::vector<NamedMesh> all_sorts_of_meshes() {
  std::mt19937 random(7);
  const Mesh sphere = closed_surface(12, 7), torus = grid(9, 8, true, true), sheet = grid(10, 6);
  std::vector<NamedMesh> meshes = {
      {"nothing", {0, {}}},
      {"one vertex", {1, {}}},
      {"isolated vertices", {50, {}}},
      {"one triangle", {3, {{0, 1, 2}}}},
      {"tetrahedron", tetrahedron()},
      {"sheet", sheet},
      {"tube", grid(7, 5, true)},
      {"sphere", sphere},
      {"torus", torus},
      {"two-vertex torus", grid(2, 2, true, true)},
      {"one-vertex torus", grid(1, 1, true, true)},
      {"components", joined(joined(torus, sheet), joined(sphere, tetrahedron()))},
      {"isolated between components", joined(joined({5, {}}, sheet), joined({3, {}}, torus))},
      {"bow tie", {5, {{0, 1, 2}, {0, 3, 4}}}},
      {"fins on an edge", {6, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}, {0, 1, 5}}}},
      {"the same face four times", {3, {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 1, 2}}}},
      {"a face and its back", {3, {{0, 1, 2}, {0, 2, 1}}}},
      {"degenerate", {4, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, 3, 3}, {0, 1, 2}, {3, 3, 3}}}},
      {"flipped", with_flips(sphere, 0.3, random)},
      {"holes", with_holes(grid(20, 20), 0.3, random)},
      {"duplicates", with_duplicates(torus, 40, random)},
      {"everything",
       joined(with_duplicates(with_flips(with_holes(sphere, 0.1, random), 0.1, random), 9, random),
              random_soup(30, 60, random))}};
  for (std::uint32_t vertices : {1u, 2u, 3u, 5u, 9u, 40u}) {
    for (std::size_t faces : {1u, 7u, 100u}) {
      meshes.push_back({"soup " + std::to_string(vertices) + "/" + std::to_string(faces),
                        random_soup(vertices, faces, random)});
    }
  }
  const std::size_t count = meshes.size();
  for (std::size_t i = 0; i < count; ++i) {
    meshes.push_back({meshes[i].name + ", shuffled", shuffled(meshes[i].mesh, random)});
  }
  return meshes;
}

}  // namespace tvg::test
