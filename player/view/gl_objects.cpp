#include "player/view/gl_objects.hpp"

#include "cli/tool_error.hpp"

#include <array>

namespace tvg::cli {

namespace {

void attach_shader(GLuint program, GLenum stage, const std::string& text) {
  if (text.empty()) return;
  const GLuint shader = glCreateShader(stage);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  glDeleteShader(shader);  // goes with the program
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return;
  std::array<char, 1024> log{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw ToolError(ExitStatus::kOther, std::string("the OpenGL driver refuses a shader: ") + log.data());
}

}  // namespace

void release_buffer(GLuint name) {
  glDeleteBuffers(1, &name);
}
void release_vertex_array(GLuint name) {
  glDeleteVertexArrays(1, &name);
}
void release_texture(GLuint name) {
  glDeleteTextures(1, &name);
}
void release_renderbuffer(GLuint name) {
  glDeleteRenderbuffers(1, &name);
}
void release_framebuffer(GLuint name) {
  glDeleteFramebuffers(1, &name);
}
void release_program(GLuint name) {
  glDeleteProgram(name);
}

GlBuffer make_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return GlBuffer(name);
}
GlVertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return GlVertexArray(name);
}
GlTexture make_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  return GlTexture(name);
}
GlRenderbuffer make_renderbuffer() {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  return GlRenderbuffer(name);
}
GlFramebuffer make_framebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  return GlFramebuffer(name);
}

GlProgram make_program(const ShaderText& text) {
  GlProgram program(glCreateProgram());
  attach_shader(program.get(), GL_VERTEX_SHADER, text.vertex);
  attach_shader(program.get(), GL_GEOMETRY_SHADER, text.geometry);
  attach_shader(program.get(), GL_FRAGMENT_SHADER, text.fragment);
  glLinkProgram(program.get());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.get(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  std::array<char, 1024> log{};
  glGetProgramInfoLog(program.get(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw ToolError(ExitStatus::kOther, std::string("the OpenGL driver refuses a program: ") + log.data());
}

}  // namespace tvg::cli
