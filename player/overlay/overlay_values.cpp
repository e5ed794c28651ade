#include "player/overlay/overlay_values.hpp"

#include "tool/tool_error.hpp"

#include <algorithm>
#include <cmath>

#include <tvg/measure.hpp>

namespace tvg::player {

void importance_values(std::span<const std::uint8_t> flags, std::span<float> values) {
  std::transform(flags.begin(), flags.end(), values.begin(),
                 [](std::uint8_t flag) { return flag != 0 ? 1.0F : 0.0F; });
}

std::vector<float> cost_values(const Mesh& mesh, const MeasuredFrames& frames, const Importance& importance) {
  static const Skeleton none;
  const Skeleton& skeleton = frames.skeleton != nullptr ? *frames.skeleton : none;
  const Result<Measure> measured = measure(mesh, frames.positions, skeleton, frames.joints, importance);
  if (!measured) throw cli::tool_error("--overlay cost", measured.error());
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

std::string short_units(const Metadata& metadata) {
  const auto units = metadata.find("units");
  return units != metadata.end() && units->second.size() <= 12 ? units->second : "";
}

}  // namespace tvg::player
