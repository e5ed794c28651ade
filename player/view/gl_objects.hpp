#pragma once
#include <epoxy/gl.h>
#include <string>
#include <utility>

namespace tvg::player {

/// Owns the name of an OpenGL object; the context it was made in must be current when it is destroyed.
template <void (*release)(GLuint)>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  ~GlName() {
    if (name_ != 0) release(name_);
  }
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;

  GLuint get() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

// OpenGL's functions are loaded at run time, so that a template cannot name them.
void release_buffer(GLuint name);
void release_vertex_array(GLuint name);
void release_texture(GLuint name);
void release_renderbuffer(GLuint name);
void release_framebuffer(GLuint name);
void release_program(GLuint name);

using GlBuffer = GlName<release_buffer>;
using GlVertexArray = GlName<release_vertex_array>;
using GlTexture = GlName<release_texture>;
using GlRenderbuffer = GlName<release_renderbuffer>;
using GlFramebuffer = GlName<release_framebuffer>;
using GlProgram = GlName<release_program>;

GlBuffer make_buffer();
GlVertexArray make_vertex_array();
GlTexture make_texture();
GlRenderbuffer make_renderbuffer();
GlFramebuffer make_framebuffer();

/// The text of a program's shaders; `geometry` may be empty.
struct ShaderText {
  std::string vertex;
  std::string geometry;
  std::string fragment;
};

/// Compiles and links. Throws ToolError (kOther) with the driver's message where it refuses.
GlProgram make_program(const ShaderText& text);

}  // namespace tvg::player
