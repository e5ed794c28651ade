#include "player/window/play_session.hpp"

#include "player/frames/shown_frames.hpp"
#include "player/overlay/overlay_values.hpp"
#include "player/view/image.hpp"
#include "player/window/window_picture.hpp"
#include "tool/atomic_file.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace tvg::player {

namespace {

constexpr double kNoticeSeconds = 3;

}  // namespace

PlaySession::PlaySession(const PlayOptions& options, Stopwatch watch, std::unique_ptr<StreamInput> input)
    : options_(options),
      watch_(watch),
      view_{options.style, options.overlay, options.axes, options.plain},
      window_(options.width, options.height, "tvg", !options.screenshot.empty(), events()) {
  camera_.set_angles(options.angles);
  if (input != nullptr) use(std::move(input));
}

void PlaySession::run() {
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

void PlaySession::use(std::unique_ptr<StreamInput> input) {
  name_ = input->name();
  window_.set_title(name_ + " - tvg");
  PlayerOptions options;
  options.loader.ring_bytes = options_.memory_bytes;
  options.loader.lod = options_.lod;
  options.loader.surfaces = true;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(name_, ignored)) options.loader.folder = folder_of({name_});
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

void PlaySession::notify(std::string notice) {
  notice_ = std::move(notice);
  notice_until_ = watch_.now() + kNoticeSeconds;
  pictures_due_ = 3;
}

double PlaySession::pause_between_looks() const {
  if (pictures_due_ > 0 || !player_) return pictures_due_ > 0 ? 0 : 0.2;
  return snapshot_.playing || snapshot_.status != PlayerSnapshot::Status::kReady ? 0.002 : 0.05;
}

void PlaySession::look(double now) {
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

void PlaySession::show(std::shared_ptr<const PlayerFrame> frame) {
  frame_ = std::move(frame);
  is_new_ = true;
  if (frame_->mesh != mesh_ || frame_->surface != surface_) {
    if (mesh_ == nullptr) begin_stream(player_->snapshot().stream.metadata);
    const bool is_other = mesh_ != frame_->mesh;
    mesh_ = frame_->mesh;
    surface_ = frame_->surface;
    send_mesh();
    if (is_other && !is_in_view()) fit_view();
  }
  send_frame();
}

/// What a stream's metadata say of its looks, unless the user has said otherwise.
void PlaySession::begin_stream(const Metadata& metadata) {
  if (!options_.shading_is_given) view_.style.shading = shading_of(metadata);
  try {
    camera_.set_orientation(options_.orientation.of(metadata));
  } catch (const cli::ToolError& error) {
    notify(error.what());
    camera_.set_orientation(Orientation(up_of(metadata)));
  }
  fitted_ = {};
}

void PlaySession::send_mesh() {
  renderer_.set_mesh(*mesh_, view_.plain ? nullptr : surface_);
}

void PlaySession::send_frame() {
  renderer_.set_frame(frame_->positions, frame_->normals, frame_->values, colour_map_of(view_.overlay),
                      frame_->colours);
}

/// Whether the view need not move for the frame: each frame of a captured volume has a mesh of its own, and
/// where the user looks from stays.
bool PlaySession::is_in_view() const {
  if (shows_nothing(*mesh_)) return true;
  if (fitted_.empty()) return false;
  BoundingBox both = fitted_, bounds;
  both.extend(frame_->positions);
  bounds.extend(frame_->positions);
  return both.diagonal() < 1.5 * fitted_.diagonal() && 4 * bounds.diagonal() > fitted_.diagonal();
}

void PlaySession::fit_view() {
  if (frame_ == nullptr) return;
  ViewExtent extent = camera_.extent(static_cast<double>(window_.width()) / std::max(1, window_.height()));
  extent.extend(frame_->positions);
  fitted_ = extent.bounds();
  renderer_.set_scene(fitted_, camera_.orientation());
  extent.pad(0.12 * view_radius(fitted_));  // frames to come move about
  camera_.fit(extent);
}

void PlaySession::draw(double now) {
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

InterfaceFacts PlaySession::facts(double now) const {
  InterfaceFacts facts;
  facts.name = std::filesystem::path(name_).filename().string();
  facts.notice = notice_;
  if (decorator_ != nullptr) {
    facts.legend = decorator_->legend();
    if (notice_.empty()) facts.notice = decorator_->problem();
    if (view_.overlay == Overlay::kError) facts.legend->units = short_units(snapshot_.stream.metadata);
  }
  facts.camera = camera_.axes();
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

bool PlaySession::settled(double now) {
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

void PlaySession::save_picture(const std::string& path) {
  wants_picture_ = false;
  try {
    write_png(path, window_picture(window_.width(), window_.height()));
    notify("saved " + path);
  } catch (const cli::ToolError& error) {
    if (path == options_.screenshot) throw;
    notify(error.what());
  }
}

void PlaySession::report() {
  if (!player_) return;
  snapshot_ = player_->snapshot();
  if (!options_.report.empty()) {
    cli::AtomicFile file(options_.report);
    file.write(figures_.report(snapshot_, name_, watch_.now()));
    file.finish();
  }
  if (snapshot_.status == PlayerSnapshot::Status::kFailed && frame_ == nullptr) {
    throw cli::ToolError(cli::ExitStatus::kInvalidInput, snapshot_.stream.message);
  }
}

}  // namespace tvg::player
