#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Stands for "no vertex".
inline constexpr std::uint32_t kNoVertex = 0xFFFFFFFF;

/// How prediction reaches a vertex: the ends n and p of the edge it was reached through and the vertex o on
/// the other side of that edge, all traversal indices below the vertex's own, or kNoVertex. When p is
/// kNoVertex, so is o; when n is, so are both.
struct Gate {
  std::uint32_t n = kNoVertex;
  std::uint32_t p = kNoVertex;
  std::uint32_t o = kNoVertex;

  bool operator==(const Gate&) const = default;
};

/// A mesh's connectivity as encoder and decoder share it: vertices are numbered in the order the traversal
/// reaches them.
struct Connectivity {
  std::vector<Face> faces;  ///< [face][corner] in traversal indices, in traversal order
  std::vector<Gate> gates;  ///< [traversal index]

  bool operator==(const Connectivity&) const = default;
};

/// Vertices and faces together that one byte of a connectivity stream may stand for (format-spec §5.1).
inline constexpr std::uint64_t kMaxElementsPerByte = 128;

/// Whether there is memory for the connectivity and for `bytes_per_vertex` beside it: what the traversal may
/// hold at once, its lists growing by doubling. Counts that are more than `connectivity` can hold are left to
/// decode_connectivity(); every other vertex and face has its share of a byte, so that this is in proportion
/// to the payload.
bool can_allocate_connectivity(std::span<const std::uint8_t> connectivity, std::uint32_t vertex_count,
                               std::uint32_t face_count, std::size_t bytes_per_vertex);

/// Decodes the connectivity of a mesh of `vertex_count` vertices and `face_count` faces from all of `bytes`
/// (format-spec §5.1). Memory and time are in proportion to `bytes`. The only errors are kLimitExceeded, when
/// the counts are more than `bytes` can hold, and kMalformed.
Result<Connectivity> decode_connectivity(std::span<const std::uint8_t> bytes, std::uint32_t vertex_count,
                                         std::uint32_t face_count);

}  // namespace tvg
