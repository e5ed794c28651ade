#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tvg::player {

/// A picture in memory: 8 bits each of red, green, blue and alpha, sRGB.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< [row from the top][column][rgba], 4 * width * height bytes

  const std::uint8_t* pixel(int column, int row) const {
    return pixels.data() + 4 * (std::size_t(row) * std::size_t(width) + std::size_t(column));
  }
};

/// The bytes of a PNG with alpha, without time or names. Throws ToolError (kOther) where that fails.
std::string png_with_alpha(const Image& image);

/// Writes a PNG (RGB: alpha is dropped) that holds no time and no names, so that one image always gives the
/// same bytes. The file appears when it is complete. "-" is standard output. Throws ToolError (kIo).
void write_png(const std::string& path, const Image& image);

/// Reads a PNG of at most 8192 pixels a side; colours of any kind become RGBA. Throws ToolError: kIo where
/// the file cannot be read, kInvalidInput where it is no such PNG.
Image read_png(const std::string& path);

/// How far two pictures of one size lie apart.
struct ImageDifference {
  double mean = 0;       ///< mean absolute difference of the red, green and blue values, 0 to 255
  double far_share = 0;  ///< share of pixels with a value off by more than the limit asked for, 0 to 1
};

/// Compares colours; alpha does not count. `limit`: 0 to 255. Throws std::invalid_argument for pictures of
/// different sizes.
ImageDifference compare_images(const Image& a, const Image& b, int limit);

}  // namespace tvg::player
