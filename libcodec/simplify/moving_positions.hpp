#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

/// The path of every vertex, frames side by side, moved and scaled so that the largest extent over all frames
/// is 1.
class MovingPositions {
 public:
  MovingPositions(std::uint32_t vertex_count, std::span<const FramePositions> frames);

  std::size_t frame_count() const { return frame_count_; }
  /// [axis][frame], 3 * frame_count() values.
  const float* path(std::uint32_t vertex) const { return values_.data() + 3 * frame_count_ * vertex; }

 private:
  std::size_t frame_count_;
  std::vector<float> values_;  ///< [vertex][axis][frame]
};

/// What is taken off positions and what they are then multiplied by, for a largest extent of 1.
struct UnitScale {
  std::array<double, 3> center{};
  double factor = 1;
};
UnitScale unit_scale(std::span<const FramePositions> frames);

}  // namespace tvg
