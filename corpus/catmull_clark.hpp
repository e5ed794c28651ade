#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tvg::corpus {

/// Position (first three) and the finger channels a control vertex carries through subdivision.
constexpr std::size_t kCageChannels = 8;
using CageVertex = std::array<double, kCageChannels>;

/// A closed manifold quad mesh.
struct Cage {
  std::vector<CageVertex> vertices;
  std::vector<std::array<std::uint32_t, 4>> quads;  ///< counter-clockwise seen from outside
};

/// One step of Catmull-Clark subdivision on every channel: each quad becomes four, vertices are kept first.
Cage subdivide(const Cage& cage);

}  // namespace tvg::corpus
