#include "measure/velocity.hpp"

#include <cmath>

namespace tvg {

std::vector<double> velocity_criterion(const CriterionInput& input) {
  std::vector<double> speed(input.mesh().vertex_count, 0.0);
  const double diagonal = box_around(input.frames).diagonal();
  if (!(diagonal > 0) || input.frames.size() < 2) return speed;
  const double scale = 1 / (diagonal * static_cast<double>(input.frames.size() - 1));
  for (std::size_t f = 1; f < input.frames.size(); ++f) {
    const FramePositions& last = input.frames[f - 1];
    const FramePositions& frame = input.frames[f];
    for (std::size_t v = 0; v < speed.size(); ++v) {
      const std::size_t x = 3 * v;
      speed[v] += scale * std::hypot(double{frame[x]} - last[x], double{frame[x + 1]} - last[x + 1],
                                     double{frame[x + 2]} - last[x + 2]);
    }
  }
  return speed;
}

}  // namespace tvg
