#include "cli/gop_statistics.hpp"

#include <algorithm>
#include <numeric>

namespace tvg::cli {

namespace {

/// The value at a share of the way through `sorted`, which is not empty.
double value_at(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(rank, sorted.size() - 1)];
}

CostHistogram histogram_of(const std::vector<double>& sorted) {
  CostHistogram histogram{sorted.front(), value_at(sorted, kShareBelowHistogramEnd),
                          std::vector<std::uint64_t>(kHistogramBins)};
  if (!(histogram.high > histogram.low)) histogram.high = sorted.back();
  const double extent = histogram.high - histogram.low;
  for (const double cost : sorted) {
    const double bin = extent > 0 ? (cost - histogram.low) / extent * double{kHistogramBins} : 0;
    ++histogram.counts[static_cast<std::size_t>(std::min(bin, double{kHistogramBins - 1}))];
  }
  return histogram;
}

}  // namespace

GopStatistics statistics_of(const GopMeasure& gop, std::span<const std::uint8_t> previous_flags) {
  const std::vector<double>& cost = gop.measure.cost;
  const std::vector<std::uint8_t>& flags = gop.measure.flags;
  std::vector<double> sorted = cost;
  std::sort(sorted.begin(), sorted.end());

  GopStatistics statistics;
  statistics.first_frame = gop.first_frame;
  statistics.frame_count = gop.frames.size();
  statistics.measured_frames = gop.measured_frames;
  statistics.smallest = sorted.front();
  statistics.median = value_at(sorted, 0.5);
  statistics.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
  statistics.largest = sorted.back();
  statistics.histogram = histogram_of(sorted);
  for (std::size_t v = 0; v < flags.size(); ++v) {
    if (!previous_flags.empty() && previous_flags[v] != flags[v]) ++statistics.changed;
    if (flags[v] == 0) continue;
    ++statistics.important;
    statistics.lowest_important = std::min(statistics.lowest_important.value_or(cost[v]), cost[v]);
  }
  statistics.joints = gop.measure.joints;
  return statistics;
}

}  // namespace tvg::cli
