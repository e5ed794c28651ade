#include "player/window/play_window.hpp"

#include "player/view/image.hpp"
#include "player/window/glfw_window.hpp"
#include "player/window/interface.hpp"
#include "player/window/overlay_decorators.hpp"
#include "player/window/play_figures.hpp"
#include "player/window/window_picture.hpp"
#include "tool/atomic_file.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

constexpr double kNoticeSeconds = 3;

/// Seconds since the command began.
class Stopwatch {
 public:
  double now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class PlayWindow {
 public:
  PlayWindow(const PlayOptions& options, Stopwatch watch, std::unique_ptr<StreamInput> input)
      : options_(options),
        watch_(watch),
        view_{options.style, options.overlay},
        window_(options.width, options.height, "tvg", !options.screenshot.empty(), events()) {
    camera_.set_angles(options.angles);
    if (input != nullptr) use(std::move(input));
  }

  void run() {
    while (!window_.closing()) {
      const bool happened = window_.handle_events(pause_between_looks());
      const double now = watch_.now();
      if (options_.seconds && now >= *options_.seconds) break;
      if (happened) pictures_due_ = 3;  // ImGui shows what an event does one or two pictures later
      look(now);
      if (pictures_due_ > 0 && window_.visible()) draw(now);
      if (finished_) break;
    }
    report();
  }

 private:
  WindowEvents events() {
    return {[this](Action action) { act(action); }, [this](const std::string& path) { open(path); },
            [this](double steps) { camera_.zoom_by(std::pow(1.12, steps)); },
            [this](double x, double y, bool turns) {
              turns ? camera_.orbit(-220 * x, 220 * y) : camera_.pan(x, -y);
            },
            [this] { fit_view(); }};
  }

  void open(const std::string& location) {
    try {
      use(open_stream_input(location));
    } catch (const ToolError& error) {
      notify(error.what());
    }
  }

  void use(std::unique_ptr<StreamInput> input) {
    name_ = input->name();
    window_.set_title(name_ + " - tvg");
    PlayerOptions options;
    options.loader.ring_bytes = options_.memory_bytes;
    options.playing = !options_.paused && options_.screenshot.empty();
    options.looping = options_.looping;
    options.rate = options_.rate;
    frame_.reset();
    mesh_.reset();
    player_.emplace(std::move(input), options);
    player_->set_speed(options_.speed, watch_.now());
    if (options_.start > 0) player_->seek(options_.start, watch_.now());
    set_overlay(view_.overlay);
  }

  void set_overlay(Overlay overlay) {
    try {
      decorator_ = make_overlay_decorator(overlay, options_.reference, options_.open_source);
    } catch (const ToolError& error) {
      notify(error.what());
      return;
    }
    view_.overlay = overlay;
    if (player_) player_->set_decorator(decorator_, watch_.now());
  }

  void next_overlay() {
    const bool has_reference = !options_.reference.empty();
    switch (view_.overlay) {
      case Overlay::kNone:
        return set_overlay(Overlay::kImportance);
      case Overlay::kImportance:
        return set_overlay(Overlay::kCost);
      case Overlay::kCost:
        return set_overlay(has_reference ? Overlay::kError : Overlay::kNone);
      case Overlay::kError:
        return set_overlay(Overlay::kNone);
    }
  }

  void notify(std::string notice) {
    notice_ = std::move(notice);
    notice_until_ = watch_.now() + kNoticeSeconds;
    pictures_due_ = 3;
  }

  /// Nothing is drawn while nothing changes; how long to sleep before looking again.
  double pause_between_looks() const {
    if (pictures_due_ > 0 || !player_) return pictures_due_ > 0 ? 0 : 0.2;
    return snapshot_.playing || snapshot_.status != PlayerSnapshot::Status::kReady ? 0.002 : 0.05;
  }

  /// Asks the player for the frame to show now.
  void look(double now) {
    if (!notice_.empty() && now > notice_until_) notice_.clear(), pictures_due_ = 1;
    if (!player_) return;
    std::shared_ptr<const PlayerFrame> frame = player_->update(now);
    const bool refresh = now >= next_refresh_;
    if (frame == frame_ && !refresh) return;
    if (frame != frame_ && frame != nullptr) show(std::move(frame));
    snapshot_ = player_->snapshot();
    const bool turning = snapshot_.status == PlayerSnapshot::Status::kOpening ||
                         snapshot_.status == PlayerSnapshot::Status::kBuffering;
    next_refresh_ = now + (turning ? 0.05 : 0.25);
    pictures_due_ = std::max(pictures_due_, 1);
  }

  void show(std::shared_ptr<const PlayerFrame> frame) {
    frame_ = std::move(frame);
    is_new_ = true;
    if (frame_->mesh != mesh_) {
      mesh_ = frame_->mesh;
      renderer_.set_mesh(*mesh_);
      fit_view();
    }
    const ColourMap map = view_.overlay == Overlay::kImportance ? ColourMap::kFlags : ColourMap::kViridis;
    renderer_.set_frame(frame_->positions, frame_->normals, frame_->values, map);
  }

  void fit_view() {
    if (frame_ == nullptr) return;
    const Metadata metadata = player_->snapshot().stream.metadata;
    const auto axis = metadata.find("up");
    const UpAxis up = axis != metadata.end() && axis->second == "z" ? UpAxis::kZ : UpAxis::kY;
    Bounds bounds;
    bounds.extend(frame_->positions);
    renderer_.set_scene(bounds, up);
    bounds.pad(0.06);  // frames to come move about
    const double aspect = static_cast<double>(window_.width()) / std::max(1, window_.height());
    camera_.fit_closely(bounds, up, aspect);
  }

  void draw(double now) {
    const Viewport viewport{0, 0, window_.width(), window_.height()};
    // Without a graphics card, fewer faces keep the pace; a still picture has them all.
    view_.style.draft = window_.draws_in_software() && snapshot_.playing;
    if (frame_ != nullptr) {
      renderer_.draw(camera_, view_.style, viewport);
    } else {
      renderer_.draw_background(view_.style, viewport);
    }
    window_.begin_interface();
    follow(draw_interface(player_ ? &snapshot_ : nullptr, facts(now), view_));
    window_.end_interface();
    --pictures_due_;
    if (wants_picture_) save_picture(free_picture_name());
    if (!options_.screenshot.empty() && settled(now)) {
      save_picture(options_.screenshot);
      finished_ = true;
    }
    window_.present();
    const double done = watch_.now();
    figures_.add_picture(done - now);
    if (std::exchange(is_new_, false)) figures_.add_frame(done);
  }

  InterfaceFacts facts(double now) const {
    InterfaceFacts facts;
    facts.name = std::filesystem::path(name_).filename().string();
    facts.notice = notice_;
    if (decorator_ != nullptr) facts.legend = decorator_->legend();
    facts.draw_ms = figures_.mean_draw_ms();
    facts.shown_per_second = figures_.shown_per_second(now);
    facts.has_reference = !options_.reference.empty();
    if (view_.chart && player_) {
      constexpr std::uint64_t kAround = 90;
      const std::uint64_t first = snapshot_.frame > kAround ? snapshot_.frame - kAround : 0;
      facts.packets = player_->frame_bytes(first, snapshot_.frame + kAround);
    }
    return facts;
  }

  /// Whether a picture of the window shows all that it will: the frame, and the frames decoded ahead.
  bool settled(double now) {
    if (frame_ == nullptr) return false;
    if (settled_since_ < 0) settled_since_ = now;
    constexpr double kLongest = 3;
    pictures_due_ = std::max(pictures_due_, 1);
    const LoaderSnapshot& stream = snapshot_.stream;
    const bool whole =
        stream.state == LoaderSnapshot::State::kEnded || stream.frames_ahead + 2 >= stream.ring_capacity;
    const bool quiet = whole && stream.has_index && now > settled_since_ + 0.3;
    return quiet || now > settled_since_ + kLongest;
  }

  void save_picture(const std::string& path) {
    wants_picture_ = false;
    try {
      write_png(path, window_picture(window_.width(), window_.height()));
      notify("saved " + path);
    } catch (const ToolError& error) {
      if (path == options_.screenshot) throw;
      notify(error.what());
    }
  }

  void follow(const InterfaceRequests& requests) {
    const double now = watch_.now();
    if (requests.action) act(*requests.action);
    if (!player_) return;
    if (requests.seek) player_->seek(*requests.seek, now);
    if (requests.speed) player_->set_speed(*requests.speed, now);
    if (requests.overlay && *requests.overlay != view_.overlay) set_overlay(*requests.overlay);
    if (requests.seek || requests.speed || requests.overlay) pictures_due_ = std::max(pictures_due_, 2);
  }

  void act(Action action) {
    if (!act_on_view(action) && player_) act_on_player(action, watch_.now());
    pictures_due_ = 3;
  }

  /// False where the action is none of these.
  bool act_on_view(Action action) {
    const auto look_from = [this](const char* view) {
      ViewAngles angles = parse_view(view);
      angles.zoom = camera_.angles().zoom;
      camera_.set_angles(angles);
    };
    switch (action) {
      case Action::kShading:
        view_.style.shading = view_.style.shading == Shading::kSmooth ? Shading::kFlat : Shading::kSmooth;
        return true;
      case Action::kWireframe:
        return view_.style.wireframe = !view_.style.wireframe, true;
      case Action::kGrid:
        return view_.style.grid = !view_.style.grid, true;
      case Action::kInfo:
        return view_.info = !view_.info, true;
      case Action::kChart:
        return view_.chart = !view_.chart, true;
      case Action::kHelp:
        return view_.help = !view_.help, true;
      case Action::kInterface:
        return view_.interface = !view_.interface, true;
      case Action::kOverlay:
        return next_overlay(), true;
      case Action::kFitView:
        return fit_view(), true;
      case Action::kFrontView:
        return look_from("front"), true;
      case Action::kRightView:
        return look_from("right"), true;
      case Action::kTopView:
        return look_from("top"), true;
      case Action::kIsoView:
        return look_from("iso"), true;
      case Action::kFullscreen:
        return window_.toggle_fullscreen(), true;
      case Action::kScreenshot:
        return wants_picture_ = true, true;
      case Action::kPaste:
        return open(window_.clipboard()), true;
      case Action::kQuit:
        return window_.close(), true;
      default:
        return false;
    }
  }

  void act_on_player(Action action, double now) {
    const PlayerSnapshot state = player_->snapshot();
    const std::uint64_t known = state.stream.frame_count.value_or(state.stream.known_frames);
    switch (action) {
      case Action::kTogglePlay:
        return player_->toggle(now);
      case Action::kStepBack:
        return player_->step(-1, now);
      case Action::kStepForward:
        return player_->step(1, now);
      case Action::kGopBack:
        return player_->seek(gop_start(state, -1), now);
      case Action::kGopForward:
        return player_->seek(gop_start(state, 1), now);
      case Action::kFirstFrame:
        return player_->seek(0, now);
      case Action::kLastFrame:
        return player_->seek(known > 0 ? known - 1 : 0, now);
      case Action::kSlower:
        return player_->set_speed(state.speed / std::sqrt(2.0), now);
      case Action::kFaster:
        return player_->set_speed(state.speed * std::sqrt(2.0), now);
      case Action::kToggleLoop:
        return player_->set_looping(!state.looping);
      default:
        return;
    }
  }

  /// First frame of the GOP before or behind the one shown; at its own start, going back leads further.
  static std::uint64_t gop_start(const PlayerSnapshot& state, int direction) {
    const std::vector<GopMark>& marks = *state.stream.gops;
    std::uint64_t found = state.frame;
    for (const GopMark& mark : marks) {
      if (direction < 0 && mark.first_frame < state.frame) found = mark.first_frame;
      if (direction > 0 && mark.first_frame > state.frame) return mark.first_frame;
    }
    return found;
  }

  void report() {
    if (!player_) return;
    snapshot_ = player_->snapshot();
    if (!options_.report.empty()) {
      AtomicFile file(options_.report);
      file.write(figures_.report(snapshot_, name_, watch_.now()));
      file.finish();
    }
    if (snapshot_.status == PlayerSnapshot::Status::kFailed && frame_ == nullptr) {
      throw ToolError(ExitStatus::kInvalidInput, snapshot_.stream.message);
    }
  }

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

}  // namespace

void run_play_window(const PlayOptions& options) {
  const Stopwatch watch;
  // First, so that a mistyped name opens no window, and a connection is on its way while one opens.
  std::unique_ptr<StreamInput> input =
      options.location.empty() ? nullptr : open_stream_input(options.location);
  PlayWindow(options, watch, std::move(input)).run();
}

}  // namespace tvg::cli
