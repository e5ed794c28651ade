#include "player/view/offscreen_context.hpp"

#include "tool/tool_error.hpp"

#include <array>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace tvg::player {

namespace {

cli::ToolError no_context(const std::string& what) {
  return {cli::ExitStatus::kOther,
          "cannot draw without a display: " + what +
              "; Mesa gives one (on Debian: apt-get install libegl1 libgl1-mesa-dri)"};
}

}  // namespace

OffscreenContext::OffscreenContext() {
  if (!epoxy_has_egl()) throw no_context("there is no EGL (libEGL.so.1) on this machine");
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") ||
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
    throw no_context("EGL has no surfaceless platform");
  }
  display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) {
    display_ = nullptr;
    throw no_context("EGL finds no driver");
  }
  constexpr std::array<EGLint, 5> kConfig = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                             EGL_NONE};
  constexpr std::array<EGLint, 7> kContext = {EGL_CONTEXT_MAJOR_VERSION,
                                              3,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              3,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
      eglChooseConfig(display_, kConfig.data(), &config, 1, &configs) == EGL_FALSE || configs < 1) {
    close();
    throw no_context("EGL has no OpenGL");
  }
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, kContext.data());
  if (context_ == EGL_NO_CONTEXT ||
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
    close();
    throw no_context("EGL gives no OpenGL 3.3 context");
  }
}

OffscreenContext::~OffscreenContext() {
  close();
}

void OffscreenContext::close() {
  if (display_ == nullptr) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
  eglTerminate(display_);
  display_ = nullptr;
}

std::string OffscreenContext::renderer() const {
  return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

}  // namespace tvg::player
