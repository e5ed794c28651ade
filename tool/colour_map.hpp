#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tvg::cli {

/// A colour in sRGB, each part 0 to 1.
struct Colour {
  float red = 0;
  float green = 0;
  float blue = 0;
};

/// How values between 0 and 1 become colours.
enum class ColourMap {
  kViridis,  ///< dark blue to yellow, of a lightness that rises evenly: for amounts
  kFlags,    ///< grey below one half, orange above: for yes and no
};

/// The colour of `value`; values outside 0 to 1, and NaN, count as the nearer end (NaN as 0).
Colour map_colour(ColourMap map, double value);

/// Samples of a colour map for a texture.
inline constexpr int kColourMapSamples = 256;
/// [sample][rgba], evenly spaced from 0 to 1, both included.
std::array<std::uint8_t, 4 * std::size_t{kColourMapSamples}> colour_map_samples(ColourMap map);

/// The values at the two ends of a colour map.
struct ValueRange {
  float smallest = 0;
  float largest = 0;
};

/// The value that a share of `values` does not exceed (0.999: all but the highest in a thousand); 0 where
/// there are none. What is not finite does not count. `scratch` saves allocations from call to call.
float value_at_share(std::span<const float> values, double share, std::vector<float>& scratch);

/// Brings values of `range` to 0 to 1, and those beyond its ends to these; all to 0 where the range is empty.
/// In place.
void scale_values(std::span<float> values, const ValueRange& range);

}  // namespace tvg::cli
