#pragma once
#include <string>

namespace tvg::player {

/// An OpenGL 3.3 core context without window and display (EGL, surfaceless), current on the thread that made
/// it until it is destroyed.
class OffscreenContext {
 public:
  /// Throws ToolError (kOther) that says what is missing on this machine.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// What draws, as the driver names itself.
  std::string renderer() const;

 private:
  void close();

  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace tvg::player
