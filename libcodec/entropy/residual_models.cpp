#include "entropy/residual_models.hpp"

namespace tvg {

const std::array<std::uint8_t, 256> ResidualModels::kLevelOf = [] {
  std::array<std::uint8_t, 256> levels{};
  for (std::size_t activity = 0; activity < levels.size(); ++activity) {
    const auto reached = [activity](std::uint16_t threshold) { return activity >= threshold; };
    levels[activity] =
        static_cast<std::uint8_t>(std::count_if(kThresholds.begin(), kThresholds.end(), reached));
  }
  return levels;
}();

ResidualModels::ResidualModels() : cells_(kLevels) {}

}  // namespace tvg
