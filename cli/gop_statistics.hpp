#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tvg/measure.hpp>

namespace tvg::cli {

/// How the cost is spread over the vertices.
struct CostHistogram {
  double low = 0;                     ///< lower end of the first bin: the smallest cost
  double high = 0;                    ///< upper end of the last bin; costs above it count there
  std::vector<std::uint64_t> counts;  ///< [bin], of equal width
};

/// What the measure says of a GOP, without its vertices.
struct GopStatistics {
  std::uint64_t first_frame = 0;  ///< counted from the source's first
  std::uint64_t frame_count = 0;
  std::uint64_t measured_frames = 0;                       ///< see GopMeasure
  double smallest = 0, median = 0, mean = 0, largest = 0;  ///< of the cost
  CostHistogram histogram;
  std::uint64_t important = 0;             ///< vertices
  std::optional<double> lowest_important;  ///< the smallest cost of an important vertex
  std::uint64_t changed = 0;               ///< vertices whose flag differs from the GOP before
  std::vector<JointMotion> joints;         ///< [joint]; empty unless a criterion uses the skeleton
};

constexpr std::size_t kHistogramBins = 16;
/// The histogram's bins reach up to the cost that this share of vertices does not exceed: a few vertices far
/// above all others would leave the rest in one bin.
constexpr double kShareBelowHistogramEnd = 0.99;

/// `previous_flags`: of the GOP before, [vertex]; empty for the first.
GopStatistics statistics_of(const GopMeasure& gop, std::span<const std::uint8_t> previous_flags);

}  // namespace tvg::cli
