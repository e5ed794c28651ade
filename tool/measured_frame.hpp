#pragma once
#include "tool/colour_map.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <tvg/measure.hpp>

namespace tvg::cli {

/// A frame with the measure of its GOP, to be looked at.
struct MeasuredFrame {
  std::uint64_t number = 0;           ///< in the sequence
  FramePositions positions;           ///< [vertex][xyz]
  std::vector<float> cost;            ///< [vertex]
  std::vector<std::uint8_t> flags;    ///< [vertex]: 1 important
  std::vector<float> joints;          ///< [joint][xyz]; empty unless a criterion uses the skeleton
  std::vector<std::uint8_t> dynamic;  ///< [joint]
};

/// The frame at `index` of a GOP, whose first frame is the sequence's `first_number`th.
MeasuredFrame measured_frame(const GopMeasure& gop, std::size_t index, std::uint64_t first_number);

/// What the colours of a cost should reach over: from 0, or the smallest cost where some are negative, to the
/// cost that 95 % of the vertices do not exceed. Few lie far above all others.
ValueRange cost_range(const std::vector<float>& cost);

}  // namespace tvg::cli
