#pragma once
#include <cstdint>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Stands for "no half-edge".
inline constexpr std::uint32_t kNoHalfEdge = 0xFFFFFFFF;

/// Pairs half-edges that run in opposite directions between the same two vertices. Half-edge 3 f + c runs
/// from corner c of face f to the next. Returns [half-edge] = its partner, or kNoHalfEdge. Where more than
/// two faces meet in an edge, as many as possible are paired; the sides of a face that has two equal corners
/// are not.
std::vector<std::uint32_t> pair_half_edges(const Mesh& mesh);

}  // namespace tvg
