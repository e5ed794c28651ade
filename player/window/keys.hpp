#pragma once
#include <optional>
#include <span>

namespace tvg::player {

/// What a key does in the window.
enum class Action {
  kTogglePlay,
  kStepBack,
  kStepForward,
  kGopBack,
  kGopForward,
  kFirstFrame,
  kLastFrame,
  kSlower,
  kFaster,
  kToggleLoop,
  kShading,
  kWireframe,
  kOverlay,
  kGrid,
  kAxes,
  kPlain,
  kFitView,
  kFrontView,
  kRightView,
  kTopView,
  kIsoView,
  kInfo,
  kChart,
  kHelp,
  kInterface,
  kFullscreen,
  kScreenshot,
  kPaste,
  kQuit,
};

/// A key of GLFW's with its modifiers, and how the help names them.
struct KeyBinding {
  int key = 0;
  int modifiers = 0;
  Action action = Action::kTogglePlay;
  const char* keys = "";  ///< as it is written on the keyboard; "" for a second key to the same action
  const char* text = "";  ///< what it does
};

/// All of them, in the order in which the help shows them.
std::span<const KeyBinding> key_bindings();

/// The action of a key.
std::optional<Action> action_of(int key, int modifiers);

}  // namespace tvg::player
