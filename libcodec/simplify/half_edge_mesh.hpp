#pragma once
#include "connectivity/connectivity.hpp"
#include "simplify/cut_mesh.hpp"

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

static_assert(OM_VERSION >= 0x90000, "OpenMesh 9 or later is needed");

/// Three places in a ring, counter-clockwise.
using RingTriangle = std::array<std::uint32_t, 3>;

/// What surrounds a vertex, counter-clockwise: a cycle, or on a boundary a chain.
struct Ring {
  std::uint32_t center = 0;
  bool closed = true;
  std::vector<std::uint32_t> vertices;  ///< [place] of the cut mesh
  std::vector<std::uint32_t> origins;   ///< [place] the original's
  std::vector<std::uint32_t> faces;     ///< [place] of the center, the vertex here and the next one
  /// [place] the original's vertex across the edge from here to the next one, or kNoVertex at a boundary.
  std::vector<std::uint32_t> across;

  std::size_t size() const { return vertices.size(); }
};

/// A cut mesh that loses vertices. Numbers of vertices and faces stay; a face that fills the hole of a vertex
/// takes the number of one that was there.
class HalfEdgeMesh {
 public:
  explicit HalfEdgeMesh(CutMesh cut);

  std::size_t vertex_count() const { return cut_.origin.size(); }  ///< with those removed
  std::size_t face_count() const { return faces_.size(); }         ///< with those removed
  bool has_face(std::uint32_t face) const { return alive_[face] != 0; }
  /// Vertices of the cut mesh; of a face that is there.
  const Face& face(std::uint32_t face) const { return faces_[face]; }
  Face original_face(std::uint32_t face) const;
  std::uint32_t origin(std::uint32_t vertex) const { return cut_.origin[vertex]; }
  const CutMesh& cut() const { return cut_; }
  /// Whether the vertex is there and no copy of a vertex that was cut.
  bool removable(std::uint32_t vertex) const { return removable_[vertex] != 0; }
  std::uint32_t degree(std::uint32_t vertex) const;

  /// The ring of a vertex that is there. False where it meets a vertex of the original twice.
  bool ring_of(std::uint32_t vertex, Ring& ring) const;
  /// Whether a hole filled so gives an edge or a face that is there already.
  bool repeats(const Ring& ring, std::span<const RingTriangle> triangles) const;
  /// Removes the ring's center and fills the hole. Gives the faces' numbers, [triangle].
  void remove(const Ring& ring, std::span<const RingTriangle> triangles, std::vector<std::uint32_t>& filled);

  /// The faces that are there, over the original's vertices.
  Mesh present() const;

 private:
  bool has_edge(std::uint32_t a, std::uint32_t b, std::uint32_t but) const;
  bool has_other_face(const Ring& ring, const RingTriangle& triangle) const;
  void fill(const Ring& ring, const RingTriangle& triangle, std::uint32_t number_of_face);

  CutMesh cut_;
  OpenMesh::PolyConnectivity kernel_;
  std::vector<Face> faces_;
  std::vector<std::uint8_t> alive_, removable_;
  std::vector<OpenMesh::HalfedgeHandle> inside_;  ///< [from][to] places of a ring: the side in the hole
  std::vector<OpenMesh::EdgeHandle> spokes_;      ///< edges to be had for others
};

}  // namespace tvg
