#include "player/window/keys.hpp"

#include <GLFW/glfw3.h>
#include <array>

namespace tvg::player {

namespace {

// Where f3d and usdview have a key for the same thing, it is the same here.
constexpr std::array kBindings = {
    KeyBinding{GLFW_KEY_SPACE, 0, Action::kTogglePlay, "Space", "play, pause"},
    KeyBinding{GLFW_KEY_LEFT, 0, Action::kStepBack, "Left", "one frame back"},
    KeyBinding{GLFW_KEY_RIGHT, 0, Action::kStepForward, "Right", "one frame on"},
    KeyBinding{GLFW_KEY_LEFT, GLFW_MOD_SHIFT, Action::kGopBack, "Shift Left", "one GOP back"},
    KeyBinding{GLFW_KEY_RIGHT, GLFW_MOD_SHIFT, Action::kGopForward, "Shift Right", "one GOP on"},
    KeyBinding{GLFW_KEY_HOME, 0, Action::kFirstFrame, "Home", "first frame"},
    KeyBinding{GLFW_KEY_END, 0, Action::kLastFrame, "End", "last frame"},
    KeyBinding{GLFW_KEY_MINUS, 0, Action::kSlower, "-", "slower"},
    KeyBinding{GLFW_KEY_EQUAL, 0, Action::kFaster, "+", "faster"},
    KeyBinding{GLFW_KEY_EQUAL, GLFW_MOD_SHIFT, Action::kFaster, "", ""},
    KeyBinding{GLFW_KEY_KP_SUBTRACT, 0, Action::kSlower, "", ""},
    KeyBinding{GLFW_KEY_KP_ADD, 0, Action::kFaster, "", ""},
    KeyBinding{GLFW_KEY_L, 0, Action::kToggleLoop, "L", "loop"},
    KeyBinding{GLFW_KEY_S, 0, Action::kOverlay, "S", "next overlay: importance, cost, error"},
    KeyBinding{GLFW_KEY_D, 0, Action::kShading, "D", "smooth or flat shading"},
    KeyBinding{GLFW_KEY_E, 0, Action::kWireframe, "E", "edges"},
    KeyBinding{GLFW_KEY_G, 0, Action::kGrid, "G", "ground grid"},
    KeyBinding{GLFW_KEY_X, 0, Action::kAxes, "X", "which way x, y and z go"},
    KeyBinding{GLFW_KEY_C, 0, Action::kPlain, "C", "colours and textures, or one colour"},
    KeyBinding{GLFW_KEY_F, 0, Action::kFitView, "F", "fit the view to the frame"},
    KeyBinding{GLFW_KEY_ENTER, 0, Action::kFitView, "", ""},
    KeyBinding{GLFW_KEY_1, 0, Action::kFrontView, "1", "look from the front"},
    KeyBinding{GLFW_KEY_3, 0, Action::kRightView, "3", "look from the right"},
    KeyBinding{GLFW_KEY_7, 0, Action::kTopView, "7", "look from above"},
    KeyBinding{GLFW_KEY_9, 0, Action::kIsoView, "9", "look from a corner"},
    KeyBinding{GLFW_KEY_M, 0, Action::kInfo, "M", "what the stream is, and how playing goes"},
    KeyBinding{GLFW_KEY_B, 0, Action::kChart, "B", "bits of the frames"},
    KeyBinding{GLFW_KEY_U, 0, Action::kInterface, "U", "hide or show everything but the mesh"},
    KeyBinding{GLFW_KEY_F11, 0, Action::kFullscreen, "F11", "full screen"},
    KeyBinding{GLFW_KEY_F12, 0, Action::kScreenshot, "F12", "save a picture"},
    KeyBinding{GLFW_KEY_V, GLFW_MOD_CONTROL, Action::kPaste, "Ctrl V",
               "open a path or URL from the clipboard"},
    KeyBinding{GLFW_KEY_H, 0, Action::kHelp, "? or H", "this list"},
    KeyBinding{GLFW_KEY_F1, 0, Action::kHelp, "", ""},
    KeyBinding{GLFW_KEY_Q, 0, Action::kQuit, "Q", "close"},
    KeyBinding{GLFW_KEY_ESCAPE, 0, Action::kQuit, "", ""},
};

}  // namespace

std::span<const KeyBinding> key_bindings() {
  return kBindings;
}

std::optional<Action> action_of(int key, int modifiers) {
  // Locks do not count.
  const int held = modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER);
  for (const KeyBinding& binding : kBindings) {
    if (binding.key == key && binding.modifiers == held) return binding.action;
  }
  return std::nullopt;
}

}  // namespace tvg::player
