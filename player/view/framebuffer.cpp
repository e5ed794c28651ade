#include "player/view/framebuffer.hpp"

#include "tool/tool_error.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace tvg::player {

namespace {

constexpr int kSamples = 4;

}  // namespace

Framebuffer::Framebuffer(int width, int height)
    : width_(width),
      height_(height),
      drawn_(make_framebuffer()),
      resolved_(make_framebuffer()),
      drawn_colour_(make_renderbuffer()),
      drawn_depth_(make_renderbuffer()),
      resolved_colour_(make_renderbuffer()) {
  GLint most_pixels = 0;
  GLint most_samples = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most_pixels);
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  if (std::max(width, height) > most_pixels) {
    throw cli::ToolError(cli::ExitStatus::kUsage,
                         fmt::format("--size {}x{}: this machine draws pictures of at most {} "
                                     "pixels a side",
                                     width, height, most_pixels));
  }
  samples_ = most_samples >= kSamples ? kSamples : 0;
  attach(drawn_, drawn_colour_, &drawn_depth_, samples_);
  attach(resolved_, resolved_colour_, nullptr, 0);
  bind();
}

void Framebuffer::attach(const GlFramebuffer& target, GlRenderbuffer& colour, GlRenderbuffer* depth,
                         int samples) const {
  glBindFramebuffer(GL_FRAMEBUFFER, target.get());
  glBindRenderbuffer(GL_RENDERBUFFER, colour.get());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.get());
  if (depth != nullptr) {
    glBindRenderbuffer(GL_RENDERBUFFER, depth->get());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width_, height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth->get());
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw cli::ToolError(cli::ExitStatus::kOther,
                         fmt::format("the OpenGL driver has no room for a picture of {}x{} "
                                     "pixels",
                                     width_, height_));
  }
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.get());
}

void Framebuffer::read(Image& image) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.get());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.get());
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.get());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(width_);
  rows_.resize(row_bytes * static_cast<std::size_t>(height_));
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rows_.data());
  bind();

  image.width = width_;
  image.height = height_;
  image.pixels.resize(rows_.size());
  for (std::size_t row = 0; row < static_cast<std::size_t>(height_); ++row) {
    std::memcpy(image.pixels.data() + row * row_bytes,
                rows_.data() + (static_cast<std::size_t>(height_) - 1 - row) * row_bytes, row_bytes);
  }
}

}  // namespace tvg::player
