#include "measure/frames_diagonal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tvg {

double frames_diagonal(std::span<const FramePositions> frames) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const FramePositions& frame : frames) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], double{frame[i]});
      high[i % 3] = std::max(high[i % 3], double{frame[i]});
    }
  }
  return high[0] < low[0] ? 0 : std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

}  // namespace tvg
