#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// Stands for "no corner" and "no half-edge". Both are numbered 3 * face + corner, a half-edge by the corner
/// it begins at.
inline constexpr std::uint32_t kNoCorner = 0xFFFFFFFF;

/// The corner after this one in its face.
constexpr std::uint32_t next_corner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}
/// The corner before this one in its face.
constexpr std::uint32_t previous_corner(std::uint32_t corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// [half-edge]: the one that runs back along the same edge, or kNoCorner where there is none (format-spec
/// §5.7.2): where several run each way, the first of either go together, and so on. Corners are below the
/// number of vertices.
std::vector<std::uint32_t> pair_edges(std::span<const Face> faces, std::size_t vertex_count);

/// What pair_edges() takes at most, in bytes, its result included.
constexpr std::size_t pair_edges_bytes(std::size_t faces, std::size_t vertices) {
  return 36 * faces + 16 * (vertices + 1);
}

}  // namespace tvg
