#include "player/window/named_location.hpp"
#include "player/window/play_session.hpp"
#include "tool/tool_error.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace tvg::player {

WindowEvents PlaySession::events() {
  return {[this](Action action) { act(action); }, [this](const std::string& path) { open(path); },
          [this](double steps) { camera_.zoom_by(std::pow(1.12, steps)); },
          [this](double x, double y, bool turns) {
            turns ? camera_.orbit(-220 * x, 220 * y) : camera_.pan(x, -y);
          },
          [this] { fit_view(); }};
}

void PlaySession::open(const std::string& location) {
  try {
    use(open_stream_input(location, options_.lod > 0));
  } catch (const cli::ToolError& error) {
    notify(error.what());
  }
}

void PlaySession::paste() {
  const std::string location = named_location(window_.clipboard());
  if (location.empty()) return notify("the clipboard holds no path and no URL");
  open(location);
}

void PlaySession::set_overlay(Overlay overlay) {
  try {
    decorator_ = make_decorator(overlay);
  } catch (const cli::ToolError& error) {
    notify(error.what());
    return;
  }
  view_.overlay = overlay;
  if (player_) player_->set_decorator(decorator_, watch_.now());
}

std::shared_ptr<OverlayDecorator> PlaySession::make_decorator(Overlay overlay) const {
  if (overlay == Overlay::kNone) return nullptr;
  OverlaySpec spec{overlay, {}, nullptr, options_.measure};
  if (overlay == Overlay::kError) {
    spec.reference = std::make_shared<ReferenceFrames>(
        ShownFramesSpec{options_.reference, {}, false, false, false, options_.open_source}, name_);
  }
  return std::make_shared<OverlayDecorator>(spec, name_);
}

void PlaySession::next_overlay() {
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

void PlaySession::follow(const InterfaceRequests& requests) {
  const double now = watch_.now();
  if (requests.action) act(*requests.action);
  if (!player_) return;
  if (requests.seek) player_->seek(*requests.seek, now);
  if (requests.speed) player_->set_speed(*requests.speed, now);
  if (requests.overlay && *requests.overlay != view_.overlay) set_overlay(*requests.overlay);
  if (requests.seek || requests.speed || requests.overlay) pictures_due_ = std::max(pictures_due_, 2);
}

void PlaySession::act(Action action) {
  if (!act_on_view(action) && player_) act_on_player(action, watch_.now());
  pictures_due_ = 3;
}

bool PlaySession::act_on_view(Action action) {
  const auto look_from = [this](const char* view) {
    camera_.set_angles(parse_view(view));
    fit_view();
  };
  switch (action) {
    case Action::kShading:
      view_.style.shading = view_.style.shading == Shading::kSmooth ? Shading::kFlat : Shading::kSmooth;
      return true;
    case Action::kWireframe:
      return view_.style.wireframe = !view_.style.wireframe, true;
    case Action::kGrid:
      return view_.style.grid = !view_.style.grid, true;
    case Action::kAxes:
      return view_.axes = !view_.axes, true;
    case Action::kPlain:
      return toggle_plain(), true;
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
      return paste(), true;
    case Action::kQuit:
      return window_.close(), true;
    default:
      return false;
  }
}

void PlaySession::toggle_plain() {
  view_.plain = !view_.plain;
  if (frame_ == nullptr) return;
  send_mesh();
  send_frame();
}

void PlaySession::act_on_player(Action action, double now) {
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

std::uint64_t PlaySession::gop_start(const PlayerSnapshot& state, int direction) {
  const std::vector<GopMark>& marks = *state.stream.gops;
  std::uint64_t found = state.frame;
  for (const GopMark& mark : marks) {
    if (direction < 0 && mark.first_frame < state.frame) found = mark.first_frame;
    if (direction > 0 && mark.first_frame > state.frame) return mark.first_frame;
  }
  return found;
}

}  // namespace tvg::player
