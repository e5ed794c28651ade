#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <tvg/geometry.hpp>
#include <tvg/simplify.hpp>
#include <tvg/source.hpp>

// Surfaces, and what is known of a mesh, by the plainest means.
namespace tvg::test {

/// Rows x columns vertices placed by `at(row, column)` -> {x, y, z}; rows and columns close around where
/// asked.
template <class Place>
Sequence sheet(std::uint32_t rows, std::uint32_t columns, bool rows_close, bool columns_close, Place at) {
  Sequence sequence{{rows * columns, {}}, {{}}, {}};
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      for (const double x : at(r, c)) sequence.frames[0].push_back(static_cast<float>(x));
    }
  }
  const auto vertex = [=](std::uint32_t r, std::uint32_t c) { return r % rows * columns + c % columns; };
  for (std::uint32_t r = 0; r + (rows_close ? 0 : 1) < rows; ++r) {
    for (std::uint32_t c = 0; c + (columns_close ? 0 : 1) < columns; ++c) {
      sequence.mesh.faces.push_back({vertex(r, c), vertex(r, c + 1), vertex(r + 1, c + 1)});
      sequence.mesh.faces.push_back({vertex(r, c), vertex(r + 1, c + 1), vertex(r + 1, c)});
    }
  }
  return sequence;
}

inline Sequence flat_grid(std::uint32_t rows, std::uint32_t columns) {
  return sheet(rows, columns, false, false, [](auto r, auto c) {
    return std::array{double(c), double(r), 0.0};
  });
}

inline Sequence torus(std::uint32_t rows, std::uint32_t columns) {
  return sheet(rows, columns, true, true, [=](auto r, auto c) {
    const double u = 2 * std::numbers::pi * r / rows, v = 2 * std::numbers::pi * c / columns;
    const double radius = 3 + std::cos(u);
    return std::array{radius * std::cos(v), radius * std::sin(v), std::sin(u)};
  });
}

inline Sequence open_cylinder(std::uint32_t rows, std::uint32_t columns) {
  return sheet(rows, columns, false, true, [=](auto r, auto c) {
    const double v = 2 * std::numbers::pi * c / columns;
    return std::array{std::cos(v), std::sin(v), 4.0 * r / rows};
  });
}

/// An octahedron, every face of which is cut in four so many times, blown up to the unit sphere.
inline Sequence sphere(int levels) {
  std::vector<Eigen::Vector3d> points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Face> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)}, points.size());
      if (fresh) points.push_back((points[a] + points[b]).normalized());
      return at->second;
    };
    std::vector<Face> finer;
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Face& face : {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}}) {
        finer.push_back(face);
      }
    }
    faces = finer;
  }
  Sequence sequence{{static_cast<std::uint32_t>(points.size()), faces}, {{}}, {}};
  for (const Eigen::Vector3d& p : points) {
    for (const double x : p) sequence.frames[0].push_back(static_cast<float>(x));
  }
  return sequence;
}

/// By the paper's own priority, with all frames checked.
inline SimplifyOptions down_to(std::vector<std::uint32_t> counts) {
  SimplifyOptions options;
  options.vertex_counts = std::move(counts);
  options.priority = SimplifyPriority::kMaps;
  options.intersection_frames = 100;
  return options;
}

inline Result<Simplification> simplify(const Sequence& sequence, const SimplifyOptions& options) {
  return tvg::simplify(sequence.mesh, sequence.frames, {}, {}, options);
}

/// The positions of a simplified mesh's vertices, frame after frame.
inline std::vector<FramePositions> frames_of(const SimplifiedMesh& simple,
                                             const std::vector<FramePositions>& frames) {
  std::vector<FramePositions> result;
  for (const FramePositions& frame : frames) {
    FramePositions& out = result.emplace_back();
    for (const std::uint32_t v : simple.vertices) {
      for (std::size_t axis = 0; axis < 3; ++axis) out.push_back(frame[3 * std::size_t{v} + axis]);
    }
  }
  return result;
}

struct Shape {
  long euler = 0;  ///< vertices in use - edges + faces
  std::size_t boundary_edges = 0;
  std::size_t boundary_loops = 0;
  std::size_t components = 0;
  bool manifold = true;  ///< at most two faces at an edge, and these in one sense
};

inline Shape shape_of(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  std::set<std::uint32_t> used;
  std::vector<std::uint32_t> part(mesh.vertex_count), rim(mesh.vertex_count);
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) part[v] = rim[v] = v;
  const auto find = [](std::vector<std::uint32_t>& sets, std::uint32_t v) {
    while (sets[v] != v) v = sets[v];
    return v;
  };
  for (const Face& face : mesh.faces) {
    for (std::size_t c = 0; c < 3; ++c) {
      used.insert(face[c]);
      ++sides[{face[c], face[(c + 1) % 3]}];
      part[find(part, face[c])] = find(part, face[(c + 1) % 3]);
    }
  }
  Shape shape;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> on_rim, loops, parts;
  for (const auto& [side, count] : sides) {
    if (count > 1) shape.manifold = false;
    edges.insert({std::min(side.first, side.second), std::max(side.first, side.second)});
    if (sides.count({side.second, side.first}) > 0) continue;
    ++shape.boundary_edges;
    on_rim.insert({side.first, side.second});
    rim[find(rim, side.first)] = find(rim, side.second);
  }
  for (const std::uint32_t v : on_rim) loops.insert(find(rim, v));
  for (const std::uint32_t v : used) parts.insert(find(part, v));
  shape.boundary_loops = loops.size();
  shape.components = parts.size();
  shape.euler =
      static_cast<long>(used.size()) - static_cast<long>(edges.size()) + static_cast<long>(mesh.faces.size());
  return shape;
}

}  // namespace tvg::test
