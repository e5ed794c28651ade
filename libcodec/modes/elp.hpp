#pragma once
#include "planes/plane_coder.hpp"

#include <cstdint>
#include <span>

#include <tvg/types.hpp>

// What encoder and decoder of a GOP in mode elp share (format-spec §7).
namespace tvg {

/// Positions: the planes x, y and z of one frame after the other.
using PositionCoder = PlaneCoder<3>;

/// The predictor of a GOP's `frame`: nothing comes before the first one.
constexpr Predictor predictor_of(std::uint32_t frame, Predictor asked) {
  return frame == 0 ? Predictor::kSpace : asked;
}

/// The integers of a frame that the GOP's digest covers (§7.6).
inline std::span<const std::int32_t> digested(std::span<const Quad> indices) {
  return indices.empty() ? std::span<const std::int32_t>()
                         : std::span(indices.front().data(), 4 * indices.size());
}

}  // namespace tvg
