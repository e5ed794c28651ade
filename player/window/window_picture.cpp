#include "player/window/window_picture.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <filesystem>
#include <fmt/format.h>

namespace tvg::player {

Image window_picture(int width, int height) {
  Image image{width, height, std::vector<std::uint8_t>(4 * std::size_t(width) * std::size_t(height))};
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
  const std::size_t row = 4 * std::size_t(width);
  for (std::size_t low = 0, high = std::size_t(height) - 1; low < high; ++low, --high) {
    std::swap_ranges(image.pixels.begin() + static_cast<std::ptrdiff_t>(low * row),
                     image.pixels.begin() + static_cast<std::ptrdiff_t>((low + 1) * row),
                     image.pixels.begin() + static_cast<std::ptrdiff_t>(high * row));
  }
  return image;
}

std::string free_picture_name() {
  for (int number = 1;; ++number) {
    std::string name = fmt::format("tvg-{:03}.png", number);
    std::error_code ignored;
    if (!std::filesystem::exists(name, ignored)) return name;
  }
}

}  // namespace tvg::player
