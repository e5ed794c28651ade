#include "player/view/picture_file.hpp"

#include <csetjmp>
#include <cstdio>
#include <jpeglib.h>
#include <png.h>
#include <utility>

namespace tvg::player {

namespace {

constexpr unsigned kMostPixels = 8192;

bool fits(unsigned width, unsigned height) {
  return width > 0 && height > 0 && width <= kMostPixels && height <= kMostPixels;
}

bool decode_png(std::span<const std::uint8_t> bytes, Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return false;
  bool read = fits(png.width, png.height);
  if (read) {
    png.format = PNG_FORMAT_RGBA;
    image = {static_cast<int>(png.width), static_cast<int>(png.height), {}};
    image.pixels.resize(PNG_IMAGE_SIZE(png));
    read = png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) != 0;
  }
  png_image_free(&png);
  return read;
}

/// libjpeg leaves by a jump where it cannot go on.
struct JpegErrors : jpeg_error_mgr {
  std::jmp_buf jump;
};

[[noreturn]] void leave(j_common_ptr info) {
  std::longjmp(static_cast<JpegErrors*>(info->err)->jump, 1);
}

void keep_silent(j_common_ptr /*info*/, int /*level*/) {}

/// What is between the jump and its target has no destructor: rows go straight to `image`.
bool decode_jpeg(std::span<const std::uint8_t> bytes, Image& image) {
  jpeg_decompress_struct info{};
  JpegErrors errors{};
  info.err = jpeg_std_error(&errors);
  errors.error_exit = leave;
  errors.emit_message = keep_silent;
  if (setjmp(errors.jump) != 0) {
    jpeg_destroy_decompress(&info);
    return false;
  }
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, bytes.data(), bytes.size());
  jpeg_read_header(&info, TRUE);
  bool read = fits(info.image_width, info.image_height);
  if (read) {
    info.out_color_space = JCS_EXT_RGBA;
    jpeg_start_decompress(&info);
    image.width = static_cast<int>(info.output_width);
    image.height = static_cast<int>(info.output_height);
    const std::size_t row = 4 * std::size_t{info.output_width};
    image.pixels.resize(row * info.output_height);
    while (info.output_scanline < info.output_height) {
      JSAMPROW target = image.pixels.data() + row * info.output_scanline;
      jpeg_read_scanlines(&info, &target, 1);
    }
    jpeg_finish_decompress(&info);
  }
  jpeg_destroy_decompress(&info);
  return read;
}

}  // namespace

std::optional<Image> decode_picture(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t kPngBegin = 0x89;
  constexpr std::uint8_t kJpegBegin = 0xff;
  Image image;
  const bool read =
      !bytes.empty() && (bytes[0] == kPngBegin ? decode_png(bytes, image)
                                               : bytes[0] == kJpegBegin && decode_jpeg(bytes, image));
  return read ? std::optional(std::move(image)) : std::nullopt;
}

}  // namespace tvg::player
