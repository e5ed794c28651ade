#include "player/view/gl_objects.hpp"

#include "tool/tool_error.hpp"

#include <array>

namespace tvg::player {

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
  throw cli::ToolError(cli::ExitStatus::kOther,
                       std::string("the OpenGL driver refuses a shader: ") + log.data());
}

/// One object of a kind, by the function of OpenGL that makes some.
template <class Object>
Object generated(void (*generate)(GLsizei, GLuint*)) {
  GLuint name = 0;
  generate(1, &name);
  return Object(name);
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
  return generated<GlBuffer>(glGenBuffers);
}
GlVertexArray make_vertex_array() {
  return generated<GlVertexArray>(glGenVertexArrays);
}
GlTexture make_texture() {
  return generated<GlTexture>(glGenTextures);
}
GlRenderbuffer make_renderbuffer() {
  return generated<GlRenderbuffer>(glGenRenderbuffers);
}
GlFramebuffer make_framebuffer() {
  return generated<GlFramebuffer>(glGenFramebuffers);
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
  throw cli::ToolError(cli::ExitStatus::kOther,
                       std::string("the OpenGL driver refuses a program: ") + log.data());
}

}  // namespace tvg::player
