#include "measure/frames_diagonal.hpp"

#include <Eigen/Core>
#include <limits>

namespace tvg {

double frames_diagonal(std::span<const FramePositions> frames) {
  // Four vertices side by side fill whole vectors of the processor.
  using Block = Eigen::Array<float, 12, 1>;
  Block low = Block::Constant(std::numeric_limits<float>::infinity()), high = -low;
  for (const FramePositions& frame : frames) {
    const std::size_t whole = frame.size() / 12 * 12;
    for (std::size_t i = 0; i < whole; i += 12) {
      const Eigen::Map<const Block> block(frame.data() + i);
      low = block.min(low);
      high = block.max(high);
    }
    for (std::size_t i = whole; i < frame.size(); ++i) {
      const auto axis = static_cast<Eigen::Index>(i % 3);
      low[axis] = std::min(low[axis], frame[i]);
      high[axis] = std::max(high[axis], frame[i]);
    }
  }
  const auto of_axes = [](const Block& block) { return block.cast<double>().reshaped(3, 4).eval(); };
  const Eigen::Vector3d extent = of_axes(high).rowwise().maxCoeff() - of_axes(low).rowwise().minCoeff();
  return extent[0] < 0 ? 0 : extent.stableNorm();
}

}  // namespace tvg
