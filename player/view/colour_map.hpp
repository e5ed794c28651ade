#pragma once
#include <array>
#include <cstdint>

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

}  // namespace tvg::cli
