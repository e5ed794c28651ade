#include "codecs/lattice_sequence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tvg::bench {

Lattice quantize(const Sequence& sequence, int bits) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const FramePositions& frame : sequence.frames) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], double{frame[i]});
      high[i % 3] = std::max(high[i % 3], double{frame[i]});
    }
  }
  Lattice lattice;
  lattice.indices.mesh = sequence.mesh;
  lattice.indices.bits = bits;
  std::copy(low.begin(), low.end(), lattice.minimum);
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  lattice.step = extent / std::exp2(bits);
  const double last = std::exp2(bits) - 1;
  for (const FramePositions& frame : sequence.frames) {
    std::vector<std::uint16_t> indices(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
      indices[i] =
          static_cast<std::uint16_t>(std::min(std::floor((frame[i] - low[i % 3]) / lattice.step), last));
    }
    lattice.indices.frames.push_back(std::move(indices));
  }
  return lattice;
}

std::vector<FramePositions> Lattice::centres() const {
  std::vector<FramePositions> frames;
  for (const std::vector<std::uint16_t>& frame : indices.frames) {
    FramePositions positions(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
      positions[i] = static_cast<float>(minimum[i % 3] + (frame[i] + 0.5) * step);
    }
    frames.push_back(std::move(positions));
  }
  return frames;
}

}  // namespace tvg::bench
