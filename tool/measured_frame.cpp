#include "tool/measured_frame.hpp"

#include <algorithm>

namespace tvg::cli {

namespace {

constexpr double kShareBelowRangeEnd = 0.95;

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

}  // namespace tvg::cli
