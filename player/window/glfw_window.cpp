#include "player/window/glfw_window.hpp"

#include "player/window/theme.hpp"
#include "tool/tool_error.hpp"

#include <epoxy/gl.h>
// OpenGL's declarations are epoxy's.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <utility>

namespace tvg::player {

namespace {

constexpr double kDoubleClick = 0.35;  // seconds

/// What GLFW complained about last.
std::string last_complaint() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "the reason is not known";
}

[[noreturn]] void fail() {
  const std::string reason = last_complaint();
  glfwTerminate();
  throw cli::ToolError(
      cli::ExitStatus::kOther,
      "cannot open a window: " + reason + "; `tvg render` makes pictures and clips without a display");
}

}  // namespace

/// GLFW's callbacks find their window by its user pointer.
struct GlfwCallbacks {
  static GlfwWindow& owner(GLFWwindow* window) {
    auto& found = *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
    found.happened_ = true;
    return found;
  }
  static bool over_interface() { return ImGui::GetIO().WantCaptureMouse; }

  static void key(GLFWwindow* window, int key, int, int action, int modifiers) {
    const GlfwWindow& self = owner(window);
    if (action == GLFW_RELEASE || ImGui::GetIO().WantTextInput) return;
    if (const std::optional<Action> wanted = action_of(key, modifiers)) self.events_.key(*wanted);
  }
  static void character(GLFWwindow* window, unsigned int code) {
    const GlfwWindow& self = owner(window);
    if (code == '?') self.events_.key(Action::kHelp);  // wherever the keyboard has it
  }
  static void drop(GLFWwindow* window, int count, const char** paths) {
    const GlfwWindow& self = owner(window);
    if (count > 0) self.events_.drop(paths[0]);
  }
  static void scroll(GLFWwindow* window, double, double steps) {
    const GlfwWindow& self = owner(window);
    if (!over_interface()) self.events_.scroll(steps);
  }
  static void cursor(GLFWwindow* window, double x, double y) { owner(window).handle_cursor(x, y); }
  static void button(GLFWwindow* window, int button, int action, int modifiers) {
    owner(window).handle_button(button, action, modifiers);
  }
  static void refresh(GLFWwindow* window) { owner(window); }
  static void resize(GLFWwindow* window, int, int) { owner(window); }
};

GlfwWindow::GlfwWindow(int width, int height, const std::string& title, bool smooth, WindowEvents events)
    : events_(std::move(events)) {
  open(width, height, title, smooth);
  glfwSwapInterval(1);

  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, GlfwCallbacks::key);
  glfwSetCharCallback(window_, GlfwCallbacks::character);
  glfwSetDropCallback(window_, GlfwCallbacks::drop);
  glfwSetScrollCallback(window_, GlfwCallbacks::scroll);
  glfwSetCursorPosCallback(window_, GlfwCallbacks::cursor);
  glfwSetMouseButtonCallback(window_, GlfwCallbacks::button);
  glfwSetWindowRefreshCallback(window_, GlfwCallbacks::refresh);
  glfwSetFramebufferSizeCallback(window_, GlfwCallbacks::resize);

  interface_ = ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
  float scale = 1;
  glfwGetWindowContentScale(window_, &scale, nullptr);
  theme::apply(std::clamp(scale, 1.0F, 4.0F));
  ImGui_ImplGlfw_InitForOpenGL(window_, true);  // calls the callbacks set above as well
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

/// Whether the processor can keep up with smoothed edges is known only once there is a context.
void GlfwWindow::open(int width, int height, const std::string& title, bool smooth) {
  if (glfwInit() == GLFW_FALSE) fail();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) fail();
  glfwMakeContextCurrent(window_);
  const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  draws_in_software_ =
      renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos;
  if (draws_in_software_ && !smooth) return;
  glfwWindowHint(GLFW_SAMPLES, 4);
  GLFWwindow* const smoothed = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (smoothed == nullptr) return;
  glfwDestroyWindow(window_);
  window_ = smoothed;
  glfwMakeContextCurrent(window_);
}

GlfwWindow::~GlfwWindow() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(interface_);
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool GlfwWindow::handle_events(double seconds) {
  if (!happened_ && seconds > 0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
  return std::exchange(happened_, false);
}

bool GlfwWindow::closing() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void GlfwWindow::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

int GlfwWindow::width() const {
  int width = 0;
  glfwGetFramebufferSize(window_, &width, nullptr);
  return width;
}

int GlfwWindow::height() const {
  int height = 0;
  glfwGetFramebufferSize(window_, nullptr, &height);
  return height;
}

void GlfwWindow::begin_interface() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void GlfwWindow::end_interface() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void GlfwWindow::present() {
  glfwSwapBuffers(window_);
}

void GlfwWindow::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void GlfwWindow::toggle_fullscreen() {
  if (glfwGetWindowMonitor(window_) != nullptr) {
    glfwSetWindowMonitor(window_, nullptr, windowed_[0], windowed_[1], windowed_[2], windowed_[3], 0);
    return;
  }
  GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* const mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  glfwGetWindowPos(window_, &windowed_[0], &windowed_[1]);
  glfwGetWindowSize(window_, &windowed_[2], &windowed_[3]);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

std::string GlfwWindow::clipboard() const {
  const char* const text = glfwGetClipboardString(window_);
  return text != nullptr ? text : "";
}

void GlfwWindow::handle_cursor(double x, double y) {
  int height = 1;
  glfwGetWindowSize(window_, nullptr, &height);
  const double share = 1.0 / std::max(1, height);
  if (held_button_ >= 0) events_.drag((x - cursor_x_) * share, (y - cursor_y_) * share, turns_);
  cursor_x_ = x;
  cursor_y_ = y;
}

void GlfwWindow::handle_button(int button, int action, int modifiers) {
  if (action == GLFW_RELEASE) {
    if (button == held_button_) held_button_ = -1;
    return;
  }
  if (GlfwCallbacks::over_interface()) return;
  held_button_ = button;
  turns_ = button == GLFW_MOUSE_BUTTON_LEFT && (modifiers & GLFW_MOD_SHIFT) == 0;
  const double now = glfwGetTime();
  if (turns_ && now - last_click_ < kDoubleClick) events_.double_click();
  last_click_ = now;
}

}  // namespace tvg::player
