#include "cli/measured_ply.hpp"

#include "tool/measured_frame.hpp"

#include <algorithm>

namespace tvg::cli {

namespace {

std::vector<Colour> colours_of(std::vector<float> values, const ValueRange& range, ColourMap map) {
  scale_values(values, range);
  std::vector<Colour> colours(values.size());
  std::transform(values.begin(), values.end(), colours.begin(),
                 [map](float value) { return map_colour(map, double{value}); });
  return colours;
}

}  // namespace

VertexAttributes ply_attributes(const Measure& measure, MeasureColour colour) {
  const std::vector<float> cost(measure.cost.begin(), measure.cost.end());
  const std::vector<float> important(measure.flags.begin(), measure.flags.end());
  return {colour == MeasureColour::kFlags ? colours_of(important, {0, 1}, ColourMap::kFlags)
                                          : colours_of(cost, cost_range(cost), ColourMap::kViridis),
          {{"cost", cost}, {"important", important}}};
}

}  // namespace tvg::cli
