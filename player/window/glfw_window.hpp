#pragma once
#include "player/window/keys.hpp"

#include <functional>
#include <string>

struct GLFWwindow;
struct ImGuiContext;

namespace tvg::player {

/// What happens to a window.
struct WindowEvents {
  std::function<void(Action)> key;
  std::function<void(const std::string& path)> drop;
  std::function<void(double steps)> scroll;  ///< over the scene; up is positive
  std::function<void(double x, double y, bool turns)>
      drag;                            ///< over the scene, by shares of the window's height
  std::function<void()> double_click;  ///< on the scene
};

/// A window with an OpenGL 3.3 core context, current on this thread, and a Dear ImGui over it.
class GlfwWindow {
 public:
  /// Edges are smoothed where that costs little, or where `smooth` asks for it. Throws ToolError (kOther)
  /// that says why there can be no window.
  GlfwWindow(int width, int height, const std::string& title, bool smooth, WindowEvents events);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  /// Handles what has happened; waits up to `seconds` where nothing has. True where something did.
  bool handle_events(double seconds);
  bool closing() const;
  void close();
  /// Pixels to draw into.
  int width() const;
  int height() const;
  /// Whether the processor draws, for want of a graphics card.
  bool draws_in_software() const { return draws_in_software_; }
  bool visible() const { return width() > 0 && height() > 0; }

  void begin_interface();
  /// Draws the interface over what was drawn.
  void end_interface();
  /// Shows what was drawn.
  void present();

  void set_title(const std::string& title);
  void toggle_fullscreen();
  std::string clipboard() const;

 private:
  friend struct GlfwCallbacks;
  void open(int width, int height, const std::string& title, bool smooth);
  void handle_cursor(double x, double y);
  void handle_button(int button, int action, int modifiers);

  GLFWwindow* window_ = nullptr;
  ImGuiContext* interface_ = nullptr;
  WindowEvents events_;
  bool draws_in_software_ = false;
  bool happened_ = true;
  int held_button_ = -1;
  bool turns_ = true;
  double cursor_x_ = 0;
  double cursor_y_ = 0;
  double last_click_ = -1;
  int windowed_[4] = {0, 0, 0, 0};  ///< place and size to go back to from full screen
};

}  // namespace tvg::player
