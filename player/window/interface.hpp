#pragma once
#include "player/playback/player.hpp"
#include "player/view/look.hpp"
#include "player/view/text_layer.hpp"
#include "player/window/keys.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tvg::player {

/// What the user has switched on.
struct ViewSettings {
  Style style;
  Overlay overlay = Overlay::kNone;
  bool axes = false;
  bool plain = false;     ///< one colour, whatever the stream says of its surface
  bool interface = true;  ///< anything but the mesh
  bool info = true;
  bool chart = false;
  bool help = false;
};

/// What the interface shows beside the player's own facts.
struct InterfaceFacts {
  std::string name;    ///< of the stream; empty where none is open
  std::string notice;  ///< a passing line, such as where a picture was saved
  std::optional<Legend> legend;
  CameraAxes camera;
  double draw_ms = 0;  ///< mean of the pictures drawn lately
  double shown_per_second = 0;
  bool has_reference = false;
  std::vector<FrameBytes> packets;  ///< around the frame shown, for the chart
};

/// What the user asks for with the mouse.
struct InterfaceRequests {
  std::optional<Action> action;
  std::optional<std::uint64_t> seek;
  std::optional<double> speed;
  std::optional<Overlay> overlay;
};

/// Draws the controls over the scene. An ImGui frame must be begun. `player` is null where no stream is open.
InterfaceRequests draw_interface(const PlayerSnapshot* player, const InterfaceFacts& facts,
                                 const ViewSettings& settings);

}  // namespace tvg::player
