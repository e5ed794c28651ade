#include "tool/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace tvg::cli {

namespace {

/// Viridis (Smith, van der Walt, Firing; CC0) at ninths of its range; a cubic through them is within 1.5 of
/// 255 of the whole table.
constexpr std::array<std::array<double, 3>, 9> kViridisPoints = {{{68, 1, 84},
                                                                  {71, 45, 123},
                                                                  {59, 82, 139},
                                                                  {44, 114, 142},
                                                                  {33, 145, 140},
                                                                  {40, 174, 128},
                                                                  {94, 201, 98},
                                                                  {173, 220, 48},
                                                                  {253, 231, 37}}};

constexpr Colour kPlain{0.62F, 0.65F, 0.69F};
constexpr Colour kImportant{0.93F, 0.45F, 0.13F};

/// Catmull-Rom through the points.
double viridis_channel(double value, std::size_t channel) {
  constexpr auto kLast = static_cast<std::ptrdiff_t>(kViridisPoints.size()) - 1;
  const double at = value * static_cast<double>(kLast);
  const auto index = std::min(static_cast<std::ptrdiff_t>(at), kLast - 1);
  const double t = at - static_cast<double>(index);
  const auto point = [channel](std::ptrdiff_t i) {
    // Beyond its ends the curve goes on as straight as it was.
    if (i < 0) return 2 * kViridisPoints[0][channel] - kViridisPoints[1][channel];
    if (i > kLast) return 2 * kViridisPoints[kLast][channel] - kViridisPoints[kLast - 1][channel];
    return kViridisPoints[static_cast<std::size_t>(i)][channel];
  };
  const double p0 = point(index - 1);
  const double p1 = point(index);
  const double p2 = point(index + 1);
  const double p3 = point(index + 2);
  const double curve =
      p1 + t / 2 * (p2 - p0 + t * (2 * p0 - 5 * p1 + 4 * p2 - p3 + t * (3 * (p1 - p2) + p3 - p0)));
  return std::clamp(curve / 255, 0.0, 1.0);
}

}  // namespace

Colour map_colour(ColourMap map, double value) {
  const double within = value > 0 ? std::min(value, 1.0) : 0.0;
  if (map == ColourMap::kViridis) {
    return {static_cast<float>(viridis_channel(within, 0)), static_cast<float>(viridis_channel(within, 1)),
            static_cast<float>(viridis_channel(within, 2))};
  }
  // Between a vertex that is flagged and one that is not the border is drawn where it is, in the middle.
  const double steep = std::clamp((within - 0.5) * 12 + 0.5, 0.0, 1.0);
  const auto mix = [steep](float from, float to) { return from + static_cast<float>(steep) * (to - from); };
  return {mix(kPlain.red, kImportant.red), mix(kPlain.green, kImportant.green),
          mix(kPlain.blue, kImportant.blue)};
}

std::array<std::uint8_t, 4 * std::size_t{kColourMapSamples}> colour_map_samples(ColourMap map) {
  std::array<std::uint8_t, 4 * std::size_t{kColourMapSamples}> samples{};
  for (std::size_t i = 0; i < kColourMapSamples; ++i) {
    const Colour colour = map_colour(map, static_cast<double>(i) / (kColourMapSamples - 1));
    const auto byte = [](float part) { return static_cast<std::uint8_t>(std::lround(255 * part)); };
    samples[4 * i] = byte(colour.red);
    samples[4 * i + 1] = byte(colour.green);
    samples[4 * i + 2] = byte(colour.blue);
    samples[4 * i + 3] = 255;
  }
  return samples;
}

float value_at_share(std::span<const float> values, double share, std::vector<float>& scratch) {
  scratch.clear();
  std::copy_if(values.begin(), values.end(), std::back_inserter(scratch),
               [](float value) { return std::isfinite(value); });
  if (scratch.empty()) return 0;
  const auto rank =
      std::min(scratch.size() - 1, static_cast<std::size_t>(share * static_cast<double>(scratch.size())));
  const auto at = scratch.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(scratch.begin(), at, scratch.end());
  return *at;
}

void scale_values(std::span<float> values, const ValueRange& range) {
  const float extent = range.largest - range.smallest;
  for (float& value : values) {
    value = extent > 0 ? std::clamp((value - range.smallest) / extent, 0.0F, 1.0F) : 0.0F;
  }
}

}  // namespace tvg::cli
