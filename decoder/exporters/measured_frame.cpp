#include "decoder/exporters/measured_frame.hpp"

#include <algorithm>

namespace tvg::cli {

namespace {

constexpr double kShareBelowRangeEnd = 0.95;

std::vector<Colour> colours_of(std::vector<float> values, const ValueRange& range, ColourMap map) {
  scale_values(values, range);
  std::vector<Colour> colours(values.size());
  std::transform(values.begin(), values.end(), colours.begin(),
                 [map](float value) { return map_colour(map, double{value}); });
  return colours;
}

}  // namespace

MeasuredFrame measured_frame(const GopMeasure& gop, std::size_t index, std::uint64_t first_number) {
  MeasuredFrame frame;
  frame.number = first_number + index;
  frame.positions = gop.frames[index];
  frame.cost.assign(gop.measure.cost.begin(), gop.measure.cost.end());
  frame.flags = gop.measure.flags;
  if (!gop.joints.empty()) frame.joints = gop.joints[index];
  for (const JointMotion& joint : gop.measure.joints) frame.dynamic.push_back(joint.dynamic ? 1 : 0);
  return frame;
}

ValueRange cost_range(const std::vector<float>& cost) {
  const auto [smallest, largest] = std::minmax_element(cost.begin(), cost.end());
  std::vector<float> scratch;
  ValueRange range{std::min(0.0F, *smallest), value_at_share(cost, kShareBelowRangeEnd, scratch)};
  if (!(range.largest > range.smallest)) range.largest = *largest;
  return range;
}

VertexAttributes ply_attributes(const Measure& measure, MeasureColour colour) {
  const std::vector<float> cost(measure.cost.begin(), measure.cost.end());
  const std::vector<float> important(measure.flags.begin(), measure.flags.end());
  return {colour == MeasureColour::kFlags ? colours_of(important, {0, 1}, ColourMap::kFlags)
                                          : colours_of(cost, cost_range(cost), ColourMap::kViridis),
          {{"cost", cost}, {"important", important}}};
}

}  // namespace tvg::cli
