#pragma once
#include "player/view/gl_objects.hpp"
#include "player/view/image.hpp"

namespace tvg::player {

/// Something to draw into that is not a window: colour and depth, with smooth edges where the driver has 4
/// samples per pixel. Needs a current OpenGL 3.3 context for as long as it lives.
class Framebuffer {
 public:
  /// `width` and `height` in pixels, at least 1. Throws ToolError (kUsage) for a size that the driver does
  /// not have.
  Framebuffer(int width, int height);

  /// Drawing goes here from now on.
  void bind() const;
  /// Reads what was drawn; `image` gets this size, and its memory is used again where it has it.
  void read(Image& image);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Samples per pixel: 4, or 0 where the driver has no more than one.
  int samples() const { return samples_; }

 private:
  void attach(const GlFramebuffer& target, GlRenderbuffer& colour, GlRenderbuffer* depth, int samples) const;

  int width_;
  int height_;
  int samples_;
  GlFramebuffer drawn_, resolved_;
  GlRenderbuffer drawn_colour_, drawn_depth_, resolved_colour_;
  std::vector<std::uint8_t> rows_;  // as OpenGL gives them, the lowest first
};

}  // namespace tvg::player
