#include "simplify/moving_positions.hpp"

#include <algorithm>

#include <tvg/geometry.hpp>

namespace tvg {

UnitScale unit_scale(std::span<const FramePositions> frames) {
  const BoundingBox box = box_around(frames);
  const double extent = box.largest_extent();
  return {box.center(), extent > 0 ? 1 / extent : 1};
}

MovingPositions::MovingPositions(std::uint32_t vertex_count, std::span<const FramePositions> frames)
    : frame_count_(frames.size()), values_(3 * frames.size() * vertex_count) {
  const UnitScale scale = unit_scale(frames);
  // Blocks of vertices, so that what is written stays in the cache while frame after frame is read.
  constexpr std::size_t kBlock = 64;
  for (std::size_t begin = 0; begin < vertex_count; begin += kBlock) {
    const std::size_t end = std::min<std::size_t>(begin + kBlock, vertex_count);
    for (std::size_t f = 0; f < frame_count_; ++f) {
      for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
        values_[i * frame_count_ + f] =
            static_cast<float>((frames[f][i] - scale.center[i % 3]) * scale.factor);
      }
    }
  }
}

}  // namespace tvg
