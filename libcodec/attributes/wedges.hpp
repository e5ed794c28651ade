#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// The corners of a mesh by which of them share a value: a wedge is made of corners of one vertex, each next
/// to another across an edge that is no seam.
struct Wedges {
  std::vector<std::uint32_t> of_corner;  ///< [3 * face + corner]; numbered by the first corner of each
  std::vector<std::uint32_t> first;      ///< [wedge]: its first corner

  std::size_t count() const { return first.size(); }
};

/// `partner` is what pair_edges() gives; `seams`, [half-edge], is not 0 for both half-edges of a seam
/// (format-spec §5.7.2).
Wedges wedges_between(std::span<const std::uint32_t> partner, std::span<const std::uint8_t> seams);

/// [3 * face + corner]: its vertex.
std::vector<std::uint32_t> corners_of_vertices(std::span<const Face> faces);

}  // namespace tvg
