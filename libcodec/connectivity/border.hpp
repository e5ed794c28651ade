#pragma once
#include "connectivity/connectivity.hpp"

#include <cstdint>
#include <vector>

namespace tvg {

/// Stands for "no edge" in a Border.
inline constexpr std::uint32_t kNoEdge = 0xFFFFFFFF;

/// An edge of the border: a side of a triangle already coded, behind which another triangle may follow.
struct BorderEdge {
  std::uint32_t from, to;        ///< its ends, in the winding of the coded triangle
  std::uint32_t across;          ///< the coded triangle's third vertex
  std::uint32_t previous, next;  ///< its neighbours in the loop; itself when it is the loop's only edge
  bool open;                     ///< false once it has left its loop
};

/// The border between coded and uncoded triangles: loops of open edges, each edge numbered by when it was
/// opened. Every operation takes constant time (last_open: amortized).
class Border {
 public:
  explicit Border(std::uint32_t vertex_count) : edge_at_(vertex_count, kNoEdge), degree_(vertex_count, 0) {}

  const BorderEdge& edge(std::uint32_t id) const { return edges_[id]; }
  /// Number of coded triangles at a vertex, counted up to kMaxDegree.
  std::uint32_t degree(std::uint32_t vertex) const { return degree_[vertex]; }
  void raise_degree(std::uint32_t vertex) {
    if (degree_[vertex] < kMaxDegree) ++degree_[vertex];
  }

  /// True when the triangle behind `id` could be glued to the previous edge as well.
  bool meets_previous(std::uint32_t id) const {
    const BorderEdge& e = edges_[id];
    return edges_[e.previous].to == e.from && edges_[e.previous].from != e.to;
  }
  bool meets_next(std::uint32_t id) const {
    const BorderEdge& e = edges_[id];
    return edges_[e.next].from == e.to && edges_[e.next].to != e.from;
  }

  /// Opens an edge that is a loop of its own.
  std::uint32_t open(std::uint32_t from, std::uint32_t to, std::uint32_t across);
  /// Makes `after` the one that follows `before`.
  void link(std::uint32_t before, std::uint32_t after) {
    edges_[before].next = after;
    edges_[after].previous = before;
  }
  /// Takes an edge out of its loop for good.
  void close(std::uint32_t id);
  /// Puts an edge that is in no loop before another in that one's loop.
  void insert_before(std::uint32_t id, std::uint32_t added);
  /// An open edge that starts or ends at a vertex, or kNoEdge where none is known.
  std::uint32_t edge_at(std::uint32_t vertex) const { return edge_at_[vertex]; }
  /// Crosses the loops where `incoming` ends with those at the same end of `known`: two loops become one, one
  /// becomes two.
  void splice(std::uint32_t incoming, std::uint32_t known);

  /// The open edge with the largest number, or kNoEdge when none is open. Numbers above it are given again.
  std::uint32_t last_open();

  static constexpr std::uint32_t kMaxDegree = 8;

 private:
  std::vector<BorderEdge> edges_;
  std::vector<std::uint32_t> edge_at_;  ///< [vertex]
  std::vector<std::uint8_t> degree_;    ///< [vertex]
};

}  // namespace tvg
