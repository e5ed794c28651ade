#include "player/view/image.hpp"

#include "tool/atomic_file.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <png.h>
#include <stdexcept>

namespace tvg::player {

namespace {

constexpr int kMostPixels = 8192;
constexpr std::size_t kMostFileBytes = std::size_t{1} << 28;

/// libpng's simplified interface frees what it holds here, also when a ToolError passes by.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

std::vector<std::uint8_t> without_alpha(const Image& image) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.pixels.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4) {
    rgb.insert(rgb.end(), image.pixels.begin() + static_cast<std::ptrdiff_t>(i),
               image.pixels.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  return rgb;
}

/// `pixels` in the PNG's format.
std::string png_bytes(const Image& image, png_uint_32 format, const std::uint8_t* pixels) {
  PngImage png;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = format;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, nullptr) == 0)
    throw cli::ToolError(cli::ExitStatus::kOther, fmt::format("no PNG could be made: {}", png.message));
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::string png_with_alpha(const Image& image) {
  return png_bytes(image, PNG_FORMAT_RGBA, image.pixels.data());
}

void write_png(const std::string& path, const Image& image) {
  const std::string bytes = png_bytes(image, PNG_FORMAT_RGB, without_alpha(image).data());
  cli::AtomicFile file(path);
  file.write(bytes);
  file.finish();
}

Image read_png(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw cli::ToolError(cli::ExitStatus::kIo, fmt::format("{}: {}", path, std::strerror(errno)));
  std::vector<char> bytes(1 << 16);
  std::size_t size = 0;
  while (file.read(bytes.data() + size, static_cast<std::streamsize>(bytes.size() - size))) {
    size = bytes.size();
    if (size >= kMostFileBytes) {
      throw cli::ToolError(cli::ExitStatus::kInvalidInput, fmt::format("{}: too large for a picture", path));
    }
    bytes.resize(2 * size);
  }
  size += static_cast<std::size_t>(file.gcount());

  PngImage png;
  if (png_image_begin_read_from_memory(&png, bytes.data(), size) == 0) {
    throw cli::ToolError(cli::ExitStatus::kInvalidInput, fmt::format("{}: no PNG: {}", path, png.message));
  }
  if (png.width > kMostPixels || png.height > kMostPixels) {
    throw cli::ToolError(cli::ExitStatus::kInvalidInput,
                         fmt::format("{}: {}x{} pixels; at most {} a side are read", path, png.width,
                                     png.height, kMostPixels));
  }
  png.format = PNG_FORMAT_RGBA;
  Image image{static_cast<int>(png.width), static_cast<int>(png.height), {}};
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0) {
    throw cli::ToolError(cli::ExitStatus::kInvalidInput,
                         fmt::format("{}: broken PNG: {}", path, png.message));
  }
  return image;
}

ImageDifference compare_images(const Image& a, const Image& b, int limit) {
  if (a.width != b.width || a.height != b.height) {
    throw std::invalid_argument(
        fmt::format("pictures of {}x{} and {}x{} pixels", a.width, a.height, b.width, b.height));
  }
  std::uint64_t sum = 0;
  std::uint64_t far = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
    int most = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const int difference = std::abs(a.pixels[i + channel] - b.pixels[i + channel]);
      sum += static_cast<std::uint64_t>(difference);
      most = std::max(most, difference);
    }
    far += most > limit ? 1 : 0;
  }
  const double pixels = std::max(1.0, static_cast<double>(a.pixels.size()) / 4);
  return {static_cast<double>(sum) / (3 * pixels), static_cast<double>(far) / pixels};
}

}  // namespace tvg::player
