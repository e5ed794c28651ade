#include "decoder/exporters/measured_frame.hpp"

#include "cli/atomic_file.hpp"
#include "decoder/exporters/mesh_writers.hpp"

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

void write_measured_ply(const std::string& path, const Mesh& mesh, const MeasuredFrame& frame,
                        MeasureColour colour) {
  const std::vector<float> important(frame.flags.begin(), frame.flags.end());
  VertexAttributes attributes;
  attributes.colours = colour == MeasureColour::kFlags
                           ? colours_of(important, {0, 1}, ColourMap::kFlags)
                           : colours_of(frame.cost, cost_range(frame.cost), ColourMap::kViridis);
  attributes.named = {{"cost", frame.cost}, {"important", important}};
  AtomicFile file(path);
  write_coloured_ply(file, mesh, frame.positions, attributes);
  file.finish();
}

}  // namespace tvg::cli
