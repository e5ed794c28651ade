#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

// The pyramid: an order of the vertices from coarse to fine, and for each vertex the ones decoded before it
// that are nearest along the surface, with weights that predict it from them (format-spec §5.4).
namespace tvg {

/// Neighbours a vertex may be predicted from.
inline constexpr std::uint32_t kMinPyramidNeighbours = 4;
inline constexpr std::uint32_t kMaxPyramidNeighbours = 16;
/// Integer weights are in units of 2^-14.
inline constexpr int kPyramidWeightBits = 14;

/// Everything but `order` is by turn, so that a coder that goes through the turns reads it front to back.
struct Pyramid {
  std::uint32_t neighbours = 0;      ///< m: the most neighbours of a vertex
  std::uint32_t levels = 0;          ///< how many there are; 0 for no vertices
  std::vector<std::uint32_t> order;  ///< [turn] vertex, each once
  std::vector<std::uint8_t> level;   ///< [turn] 0 for the coarsest; never falls
  std::vector<std::uint8_t> count;   ///< [turn] neighbours, 0 to m
  std::vector<std::uint32_t>
      neighbour;  ///< [turn][m] vertices of earlier turns, nearest first; 0 where there is none
  /// [turn][m] weights of the neighbours, in 2^-14, of sum 2^14 where there are any; 0 where there is none.
  std::vector<std::int16_t> weight;
};

/// The pyramid of a mesh (format-spec §5.4): the same on every machine. `faces` holds valid indices; `shape`
/// is a position for each of the `vertex_count` vertices; `neighbours` is within its limits. `given`,
/// [vertex] or empty, are levels below kMaxVertexLevels, of which none up to the highest is left out:
/// vertices of a higher one have later turns than those of a lower one. Linear in the size of the mesh, for
/// each level that is given too, but for sorting, whatever the mesh; beside the result, at most 96 bytes for
/// each vertex and 96 for each face. The only error is kOutOfMemory.
Result<Pyramid> build_pyramid(std::span<const Face> faces, std::uint32_t vertex_count,
                              std::span<const std::array<std::int32_t, 3>> shape, std::uint32_t neighbours,
                              std::span<const std::uint8_t> given = {});

}  // namespace tvg
