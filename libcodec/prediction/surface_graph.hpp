#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

// The graphs that the pyramid's levels are found on: at first the edges of a mesh, then what is left of them
// when the vertices of a finer level are drawn together with those that stay (format-spec §5.4.1, §5.4.2).
namespace tvg {

using ShapePoint = std::array<std::int32_t, 3>;

/// The squared distance of two points: exact on a lattice of 24 bits, the same everywhere on any.
inline double squared_distance(const ShapePoint& a, const ShapePoint& b) {
  const double x = static_cast<double>(a[0]) - b[0], y = static_cast<double>(a[1]) - b[1],
               z = static_cast<double>(a[2]) - b[2];
  return x * x + y * y + z * z;
}

/// A link is its length and where it leads, in one number: the order of links is by length, then by place.
using Link = std::uint64_t;
inline Link make_link(std::uint32_t length, std::uint32_t to) {
  return (Link{length} << 32) | to;
}
inline std::uint32_t length_of(Link link) {
  return static_cast<std::uint32_t>(link >> 32);
}
inline std::uint32_t end_of(Link link) {
  return static_cast<std::uint32_t>(link);
}
/// Lengths add up to the largest there is at most.
inline std::uint32_t add_lengths(std::uint32_t a, std::uint32_t b) {
  return a > ~b ? ~std::uint32_t{0} : a + b;
}

/// What a link between components is longer than the distance: a search goes over its component first.
inline constexpr std::uint32_t kApart = 1u << 28;

/// Vertices have places in a graph, in ascending order of vertex; each link is there both ways, no link leads
/// to where it starts, and no two lead to the same place.
struct SurfaceGraph {
  std::vector<std::uint32_t> vertex;  ///< [place]
  std::vector<std::uint32_t> first;   ///< [place], and the end: where its links start
  std::vector<Link> links;            ///< ascending for each place

  std::uint32_t size() const { return static_cast<std::uint32_t>(vertex.size()); }
  std::span<const Link> links_of(std::uint32_t place) const {
    return std::span(links).subspan(first[place], first[place + 1] - first[place]);
  }
};

/// The edges of a mesh, 16 times as long as they are on the shape, rounded down; and links beside them, so
/// that all vertices hang together: of no length between vertices at one point, and between components,
/// longer by kApart. False without memory.
[[nodiscard]] bool edges_of(std::span<const Face> faces, std::span<const ShapePoint> shape,
                            SurfaceGraph& graph);

inline constexpr std::uint32_t kNoColour = ~std::uint32_t{0};

/// First-fit colours, [place]: going through the places in the order given, those of more than 32 links
/// before all others, each takes the least colour that none of its neighbours has taken; places that are not
/// in the order have kNoColour. False without memory.
[[nodiscard]] bool colour(const SurfaceGraph& graph, std::span<const std::uint32_t> order,
                          std::vector<std::uint32_t>& colours);

/// The graph of the places of colour 0, of which there are some, each drawn together with the places whose
/// nearest neighbour of that colour it is, or that are nearest to such along links: a link of the graph links
/// the two they are drawn to, and is longer by the ways to there; of several the shortest stays. `place` is,
/// for each old place, the new one it is drawn to. False without memory.
[[nodiscard]] bool contract(const SurfaceGraph& graph, std::span<const std::uint32_t> colours,
                            SurfaceGraph& next, std::vector<std::uint32_t>& place);

}  // namespace tvg
