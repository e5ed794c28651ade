#pragma once
#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

// Half-edge 3 f + c of a mesh runs from corner c of face f to the next corner.
namespace tvg {

/// Stands for "no half-edge".
inline constexpr std::uint32_t kNoHalfEdge = 0xFFFFFFFF;

/// A half-edge and its ends, ordered by index.
struct HalfEdge {
  std::uint32_t low, high;
  std::uint32_t id;

  bool same_edge(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

/// Every half-edge whose ends differ, by (low, high, id): those of an edge stand side by side. Time is in
/// proportion to vertices and faces, whatever the mesh.
std::vector<HalfEdge> half_edges_by_edge(const Mesh& mesh);

/// Pairs half-edges that run in opposite directions between the same two vertices. Returns [half-edge] = its
/// partner, or kNoHalfEdge. Where more than two faces meet in an edge, as many as possible are paired; the
/// sides of a face that has two equal corners are not. Time is in proportion to vertices and faces.
std::vector<std::uint32_t> pair_half_edges(const Mesh& mesh);

}  // namespace tvg
