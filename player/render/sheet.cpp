#include "player/render/sheet.hpp"

#include <algorithm>
#include <cmath>

namespace tvg::player {

SheetShape sheet_shape(std::uint64_t frames, int width, int height) {
  constexpr std::uint64_t kMostFrames = 12;
  constexpr double kAspect = 4.0 / 3;
  const int wanted = static_cast<int>(std::min(frames, kMostFrames));
  SheetShape best{wanted, 1};
  double least = INFINITY;
  for (int columns = 1; columns <= wanted; ++columns) {
    const int rows = (wanted + columns - 1) / columns;
    const double aspect = static_cast<double>(width) * rows / (static_cast<double>(height) * columns);
    const double penalty = std::abs(std::log(aspect / kAspect)) + 0.25 * (columns * rows - wanted);
    if (penalty < least) best = {columns, rows};
    least = std::min(least, penalty);
  }
  return best;
}

std::vector<std::uint64_t> spread_evenly(std::uint64_t frames, std::uint64_t count) {
  const std::uint64_t chosen = std::min(frames, count);
  std::vector<std::uint64_t> positions;
  for (std::uint64_t i = 0; i < chosen; ++i) {
    positions.push_back(chosen == 1 ? 0 : ((frames - 1) * i + (chosen - 1) / 2) / (chosen - 1));
  }
  return positions;
}

}  // namespace tvg::player
