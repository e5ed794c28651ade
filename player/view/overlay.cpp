#include "player/view/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <tvg/measure.hpp>

namespace tvg::cli {

void importance_values(std::span<const std::uint8_t> flags, std::span<float> values) {
  std::transform(flags.begin(), flags.end(), values.begin(),
                 [](std::uint8_t flag) { return flag != 0 ? 1.0F : 0.0F; });
}

std::vector<float> cost_values(const Mesh& mesh, std::span<const FramePositions> frames) {
  const Result<Measure> measured = measure(mesh, frames, {}, {}, Importance());
  if (!measured) return std::vector<float>(mesh.vertex_count, 0.0F);  // there are no frames
  return {measured->cost.begin(), measured->cost.end()};
}

void error_values(std::span<const float> frame, std::span<const float> reference, std::span<float> values) {
  for (std::size_t v = 0; v < values.size(); ++v) {
    const auto off = [&](std::size_t axis) {
      return double{frame[3 * v + axis]} - double{reference[3 * v + axis]};
    };
    values[v] = static_cast<float>(std::hypot(off(0), off(1), off(2)));
  }
}

float value_at_share(std::span<const float> values, double share, std::vector<float>& scratch) {
  scratch.clear();
  std::copy_if(values.begin(), values.end(), std::back_inserter(scratch),
               [](float value) { return std::isfinite(value); });
  if (scratch.empty()) return 0;
  const auto rank =
      std::min(scratch.size() - 1, static_cast<std::size_t>(share * static_cast<double>(scratch.size())));
  const auto at = scratch.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(scratch.begin(), at, scratch.end());
  return *at;
}

void scale_values(std::span<float> values, float largest) {
  for (float& value : values) value = largest > 0 ? std::clamp(value / largest, 0.0F, 1.0F) : 0.0F;
}

}  // namespace tvg::cli
