#pragma once
#include <cstdint>
#include <vector>

#include <tvg/source.hpp>

// Where the eye is drawn to: parts of a mesh in which errors are counted on their own. They are found from
// the original alone, by other means than the measure's.
namespace tvg::bench {

/// The share of vertices that make a region, where so many move or deform at all.
constexpr double kRegionShare = 0.25;

/// Regions of every GOP, [gop][vertex]: 1 inside.
struct Regions {
  /// The vertices that move most: the highest mean way from frame to frame.
  std::vector<std::vector<std::uint8_t>> moving;
  /// The vertices around which the surface deforms most: the highest mean, over every fifth frame, of
  /// sum |e' - R e|^2 / sum |e|^2 over the edges e at the vertex in the GOP's first frame, e' the same edges
  /// in the frame and R the rotation that fits best. Neither rigid motion nor curvature counts.
  std::vector<std::vector<std::uint8_t>> deforming;
  std::uint32_t gop_frames = 0;
};

Regions find_regions(const Sequence& sequence, std::uint32_t gop_frames);

}  // namespace tvg::bench
