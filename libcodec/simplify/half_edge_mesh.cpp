#include "simplify/half_edge_mesh.hpp"

#include "geometry/half_edges_encode.hpp"

#include <algorithm>
#include <utility>

namespace tvg {
namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::PolyConnectivity;
using OpenMesh::VertexHandle;

VertexHandle vertex_handle(std::uint32_t vertex) {
  return VertexHandle(static_cast<int>(vertex));
}

std::uint32_t number(OpenMesh::BaseHandle handle) {
  return static_cast<std::uint32_t>(handle.idx());
}

/// Links the faces of a cut mesh. Done by hand: the kernel's own way of adding faces takes none that meet
/// twice.
void link(const CutMesh& cut, PolyConnectivity& kernel) {
  kernel.reserve(cut.origin.size(), cut.partner.size(), cut.faces.size());
  for (std::size_t v = 0; v < cut.origin.size(); ++v) kernel.new_vertex();
  std::vector<HalfedgeHandle> handle(cut.partner.size());
  for (std::uint32_t h = 0; h < handle.size(); ++h) {
    if (handle[h].is_valid()) continue;
    const Face& face = cut.faces[h / 3];
    handle[h] = kernel.new_edge(vertex_handle(face[h % 3]), vertex_handle(face[(h + 1) % 3]));
    if (cut.partner[h] != kNoHalfEdge) handle[cut.partner[h]] = kernel.opposite_halfedge_handle(handle[h]);
  }
  for (std::uint32_t f = 0; f < cut.faces.size(); ++f) {
    const FaceHandle face = kernel.new_face();
    kernel.set_halfedge_handle(face, handle[3 * f]);
    for (std::uint32_t c = 0; c < 3; ++c) {
      kernel.set_face_handle(handle[3 * f + c], face);
      kernel.set_next_halfedge_handle(handle[3 * f + c], handle[3 * f + (c + 1) % 3]);
      kernel.set_halfedge_handle(vertex_handle(cut.faces[f][c]), handle[3 * f + c]);
    }
  }
  // A vertex has one fan, so at most one boundary half-edge leaves it.
  std::vector<HalfedgeHandle> leaving(cut.origin.size());
  for (std::uint32_t h = 0; h < handle.size(); ++h) {
    if (cut.partner[h] != kNoHalfEdge) continue;
    const HalfedgeHandle outside = kernel.opposite_halfedge_handle(handle[h]);
    const VertexHandle from = kernel.from_vertex_handle(outside);
    leaving[number(from)] = outside;
    kernel.set_halfedge_handle(from, outside);
  }
  for (const HalfedgeHandle outside : leaving) {
    if (!outside.is_valid()) continue;
    kernel.set_next_halfedge_handle(outside, leaving[number(kernel.to_vertex_handle(outside))]);
  }
}

bool all_differ(std::vector<std::uint32_t> numbers) {
  std::sort(numbers.begin(), numbers.end());
  return std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end();
}

}  // namespace

HalfEdgeMesh::HalfEdgeMesh(CutMesh cut) : cut_(std::move(cut)), faces_(cut_.faces) {
  link(cut_, kernel_);
  alive_.assign(faces_.size(), 1);
  removable_.resize(cut_.origin.size());
  for (std::size_t v = 0; v < removable_.size(); ++v) {
    removable_[v] = cut_.used[v] != 0 && cut_.locked[v] == 0 ? 1 : 0;
  }
}

Face HalfEdgeMesh::original_face(std::uint32_t face) const {
  const Face& f = faces_[face];
  return {cut_.origin[f[0]], cut_.origin[f[1]], cut_.origin[f[2]]};
}

std::uint32_t HalfEdgeMesh::degree(std::uint32_t vertex) const {
  return kernel_.valence(vertex_handle(vertex));
}

bool HalfEdgeMesh::ring_of(std::uint32_t vertex, Ring& ring) const {
  ring.center = vertex;
  ring.vertices.clear();
  ring.origins.clear();
  ring.faces.clear();
  ring.across.clear();
  const auto counter_clockwise = [this](HalfedgeHandle leaving) {
    return kernel_.opposite_halfedge_handle(kernel_.prev_halfedge_handle(leaving));
  };
  const HalfedgeHandle first = kernel_.halfedge_handle(vertex_handle(vertex));
  ring.closed = !kernel_.is_boundary(first);
  HalfedgeHandle spoke = ring.closed ? first : counter_clockwise(first);
  do {
    ring.vertices.push_back(number(kernel_.to_vertex_handle(spoke)));
    ring.origins.push_back(cut_.origin[ring.vertices.back()]);
    if (kernel_.is_boundary(spoke)) break;
    ring.faces.push_back(number(kernel_.face_handle(spoke)));
    const HalfedgeHandle outside = kernel_.opposite_halfedge_handle(kernel_.next_halfedge_handle(spoke));
    ring.across.push_back(
        kernel_.is_boundary(outside)
            ? kNoVertex
            : cut_.origin[number(kernel_.to_vertex_handle(kernel_.next_halfedge_handle(outside)))]);
    spoke = counter_clockwise(spoke);
  } while (spoke != first || !ring.closed);
  return all_differ(ring.origins);
}

bool HalfEdgeMesh::has_edge(std::uint32_t a, std::uint32_t b, std::uint32_t but) const {
  const std::uint32_t from = cut_.origin[a], to = cut_.origin[b];
  const auto reaches = [&](std::uint32_t vertex) {
    for (auto it = kernel_.cvv_iter(vertex_handle(vertex)); it.is_valid(); ++it) {
      if (number(*it) != but && cut_.origin[number(*it)] == to) return true;
    }
    return false;
  };
  if (cut_.copies_of[from] == kNoHalfEdge) return reaches(a);
  const std::vector<std::uint32_t>& copies = cut_.copies[cut_.copies_of[from]];
  return std::any_of(copies.begin(), copies.end(), reaches);
}

bool HalfEdgeMesh::has_other_face(const Ring& ring, const RingTriangle& triangle) const {
  // Only a face across one of the hole's edges can have the same corners, for other edges are new.
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t from = triangle[c];
    if (triangle[(c + 1) % 3] != (from + 1) % ring.size() || from >= ring.across.size()) continue;
    if (ring.across[from] == ring.origins[triangle[(c + 2) % 3]]) return true;
  }
  return false;
}

bool HalfEdgeMesh::repeats(const Ring& ring, std::span<const RingTriangle> triangles) const {
  const std::size_t n = ring.size();
  for (const RingTriangle& triangle : triangles) {
    if (has_other_face(ring, triangle)) return true;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t a = triangle[c], b = triangle[(c + 1) % 3];
      const bool of_ring = b == (a + 1) % n && (ring.closed || a + 1 < n);
      const bool chord = !ring.closed && a + 1 == n && b == 0;
      if (of_ring || (a > b && !chord)) continue;  // an edge between two new faces is asked for once
      if (has_edge(ring.vertices[a], ring.vertices[b], ring.center)) return true;
    }
  }
  return false;
}

void HalfEdgeMesh::remove(const Ring& ring, std::span<const RingTriangle> triangles,
                          std::vector<std::uint32_t>& filled) {
  const std::size_t n = ring.size();
  // What is needed of the old links, before new edges take the place of the spokes.
  const HalfedgeHandle leaving = kernel_.halfedge_handle(vertex_handle(ring.center));
  HalfedgeHandle before, after, spoke = leaving;
  if (!ring.closed) {
    before = kernel_.prev_halfedge_handle(kernel_.prev_halfedge_handle(leaving));
    after = kernel_.next_halfedge_handle(leaving);
    spoke = kernel_.opposite_halfedge_handle(kernel_.prev_halfedge_handle(leaving));
  }
  inside_.assign(n * n, HalfedgeHandle());
  spokes_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    spokes_.push_back(kernel_.edge_handle(spoke));
    if (i == ring.faces.size()) break;
    inside_[i * n + (i + 1 < n ? i + 1 : 0)] = kernel_.next_halfedge_handle(spoke);
    spoke = kernel_.opposite_halfedge_handle(kernel_.prev_halfedge_handle(spoke));
  }
  for (std::size_t i = 0; i < ring.faces.size(); ++i) {
    const VertexHandle vertex = vertex_handle(ring.vertices[i]);
    if (!kernel_.is_boundary(kernel_.halfedge_handle(vertex))) {
      kernel_.set_halfedge_handle(vertex, inside_[i * n + (i + 1 < n ? i + 1 : 0)]);
    }
  }

  for (const std::uint32_t face : ring.faces) alive_[face] = 0;
  filled.assign(ring.faces.begin(), ring.faces.begin() + static_cast<std::ptrdiff_t>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) fill(ring, triangles[t], filled[t]);

  if (!ring.closed) {
    const HalfedgeHandle chord = kernel_.opposite_halfedge_handle(inside_[(n - 1) * n]);
    kernel_.set_face_handle(chord, FaceHandle());
    kernel_.set_next_halfedge_handle(before, chord);
    kernel_.set_next_halfedge_handle(chord, after);
    kernel_.set_halfedge_handle(vertex_handle(ring.vertices.front()), chord);
    kernel_.set_halfedge_handle(vertex_handle(ring.vertices.back()), after);
  }
  kernel_.set_isolated(vertex_handle(ring.center));
  removable_[ring.center] = 0;
}

void HalfEdgeMesh::fill(const Ring& ring, const RingTriangle& triangle, std::uint32_t number_of_face) {
  const std::size_t n = ring.size();
  const FaceHandle face(static_cast<int>(number_of_face));
  std::array<HalfedgeHandle, 3> sides;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t from = triangle[c], to = triangle[(c + 1) % 3];
    if (!inside_[from * n + to].is_valid()) {
      const EdgeHandle edge = spokes_.back();
      spokes_.pop_back();
      inside_[from * n + to] = kernel_.halfedge_handle(edge, 0);
      inside_[to * n + from] = kernel_.halfedge_handle(edge, 1);
      kernel_.set_vertex_handle(inside_[from * n + to], vertex_handle(ring.vertices[to]));
      kernel_.set_vertex_handle(inside_[to * n + from], vertex_handle(ring.vertices[from]));
    }
    sides[c] = inside_[from * n + to];
    faces_[number_of_face][c] = ring.vertices[from];
  }
  for (std::size_t c = 0; c < 3; ++c) {
    kernel_.set_face_handle(sides[c], face);
    kernel_.set_next_halfedge_handle(sides[c], sides[(c + 1) % 3]);
  }
  kernel_.set_halfedge_handle(face, sides[0]);
  alive_[number_of_face] = 1;
}

Mesh HalfEdgeMesh::present() const {
  Mesh mesh{static_cast<std::uint32_t>(cut_.copies_of.size()), {}};
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    if (has_face(f)) mesh.faces.push_back(original_face(f));
  }
  return mesh;
}

}  // namespace tvg
