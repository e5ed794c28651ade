#pragma once
#include "player/playback/player.hpp"
#include "player/playback/stream_input.hpp"
#include "player/view/camera.hpp"
#include "player/view/mesh_renderer.hpp"
#include "player/window/glfw_window.hpp"
#include "player/window/interface.hpp"
#include "player/window/overlay_decorator.hpp"
#include "player/window/play_figures.hpp"
#include "player/window/play_options.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace tvg::player {

/// Seconds since the command began.
class Stopwatch {
 public:
  double now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The window of `tvg play` with what plays in it. play_session.cpp looks and draws, play_actions.cpp does
/// what keys, mouse and panels ask for.
class PlaySession {
 public:
  /// `input`: what to play first; null for nothing yet. `options` must outlive the session.
  PlaySession(const PlayOptions& options, Stopwatch watch, std::unique_ptr<StreamInput> input);
  /// Returns when the window is closed. Throws as run_play_window() does.
  void run();

 private:
  WindowEvents events();
  void open(const std::string& location);
  void paste();
  void use(std::unique_ptr<StreamInput> input);
  void set_overlay(Overlay overlay);
  std::shared_ptr<OverlayDecorator> make_decorator(Overlay overlay) const;
  void next_overlay();
  void notify(std::string notice);
  /// Nothing is drawn while nothing changes; how long to sleep before looking again.
  double pause_between_looks() const;
  /// Asks the player for the frame to show now.
  void look(double now);
  void show(std::shared_ptr<const PlayerFrame> frame);
  void begin_stream(const Metadata& metadata);
  void send_mesh();
  void send_frame();
  bool is_in_view() const;
  void fit_view();
  void draw(double now);
  InterfaceFacts facts(double now) const;
  /// Whether a picture of the window shows all that it will: the frame, and the frames decoded ahead.
  bool settled(double now);
  void save_picture(const std::string& path);
  void follow(const InterfaceRequests& requests);
  void act(Action action);
  void toggle_plain();
  /// False where the action is none of these.
  bool act_on_view(Action action);
  void act_on_player(Action action, double now);
  /// First frame of the GOP before or behind the one shown; at its own start, going back leads further.
  static std::uint64_t gop_start(const PlayerSnapshot& state, int direction);
  void report();

  const PlayOptions& options_;
  Stopwatch watch_;
  ViewSettings view_;
  GlfwWindow window_;
  MeshRenderer renderer_;
  OrbitCamera camera_;
  std::string name_;
  std::shared_ptr<OverlayDecorator> decorator_;
  std::optional<Player> player_;
  PlayerSnapshot snapshot_;
  std::shared_ptr<const PlayerFrame> frame_;  ///< the one shown
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<const Surface> surface_;
  BoundingBox fitted_;  // what the view was fitted to
  PlayFigures figures_;
  int pictures_due_ = 3;
  bool is_new_ = false;  ///< the frame shown was not presented yet
  double next_refresh_ = 0;
  double settled_since_ = -1;
  std::string notice_;
  double notice_until_ = 0;
  bool wants_picture_ = false;
  bool finished_ = false;
};

}  // namespace tvg::player
