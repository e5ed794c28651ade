#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include <tvg/types.hpp>

// Plain counts over connectivity, for tests.
namespace tvg::testing {

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // smaller index first

inline bool repeats_a_corner(const Face& f) {
  return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
}

inline Face sorted(Face face) {
  std::sort(face.begin(), face.end());
  return face;
}

/// Faces with three different corners, each set of corners once.
inline std::set<Face> proper_faces(const Mesh& mesh) {
  std::set<Face> faces;
  for (const Face& face : mesh.faces) {
    if (!repeats_a_corner(face)) faces.insert(sorted(face));
  }
  return faces;
}

/// How many proper faces each edge has.
inline std::map<Edge, int> edge_use(const Mesh& mesh) {
  std::map<Edge, int> use;
  for (const auto& [a, b, c] : proper_faces(mesh)) {
    ++use[{a, b}];
    ++use[{b, c}];
    ++use[{a, c}];
  }
  return use;
}

/// Sets that are merged step by step.
class Partition {
 public:
  explicit Partition(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// [vertex]: the number of its component; components are numbered by their first vertex.
inline std::vector<std::uint32_t> component_of_vertex(const Mesh& mesh) {
  Partition parts(mesh.vertex_count);
  for (const auto& [a, b, c] : mesh.faces) {
    parts.join(a, b);
    parts.join(b, c);
  }
  std::map<std::uint32_t, std::uint32_t> number;
  std::vector<std::uint32_t> component;
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    component.push_back(
        number.try_emplace(parts.root(v), static_cast<std::uint32_t>(number.size())).first->second);
  }
  return component;
}

inline std::uint32_t component_count(const Mesh& mesh) {
  const auto component = component_of_vertex(mesh);
  return component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1;
}

/// Closed curves of edges with one face (where no vertex touches two of them).
inline std::size_t boundary_loop_count(const Mesh& mesh) {
  Partition parts(mesh.vertex_count);
  std::set<std::uint32_t> on_boundary;
  for (const auto& [edge, use] : edge_use(mesh)) {
    if (use != 1) continue;
    parts.join(edge.first, edge.second);
    on_boundary.insert({edge.first, edge.second});
  }
  std::set<std::uint32_t> roots;
  for (const std::uint32_t v : on_boundary) roots.insert(parts.root(v));
  return roots.size();
}

/// Whether every directed edge occurs once and with its opposite: closed, manifold along edges, oriented
/// alike.
inline bool is_closed_and_oriented(const Mesh& mesh) {
  std::set<Edge> directed;
  for (const auto& [a, b, c] : mesh.faces) {
    for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      if (!directed.insert(edge).second) return false;
    }
  }
  return std::all_of(directed.begin(), directed.end(), [&](const Edge& edge) {
    return directed.count({edge.second, edge.first}) == 1;
  });
}

/// Vertices off edges of more than two faces whose proper faces form several fans.
inline std::uint32_t non_manifold_vertex_count(const Mesh& mesh) {
  std::set<std::uint32_t> on_bad_edge;
  for (const auto& [edge, use] : edge_use(mesh)) {
    if (use > 2) on_bad_edge.insert({edge.first, edge.second});
  }
  std::map<std::uint32_t, std::vector<Edge>> opposite;
  for (const auto& [a, b, c] : proper_faces(mesh)) {
    opposite[a].emplace_back(b, c);
    opposite[b].emplace_back(a, c);
    opposite[c].emplace_back(a, b);
  }
  std::uint32_t count = 0;
  for (const auto& [vertex, edges] : opposite) {
    if (on_bad_edge.count(vertex) != 0) continue;
    Partition parts(mesh.vertex_count);
    for (const auto& [a, b] : edges) parts.join(a, b);
    std::set<std::uint32_t> fans;
    for (const auto& [a, b] : edges) fans.insert(parts.root(a));
    if (fans.size() > 1) ++count;
  }
  return count;
}

}  // namespace tvg::testing
