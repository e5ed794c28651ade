#include "player/window/overlay_decorator.hpp"

#include "tool/tool_error.hpp"

#include <utility>

namespace tvg::player {

OverlayDecorator::OverlayDecorator(const OverlaySpec& spec, std::string stream)
    : overlay_(spec.overlay),
      joints_(spec.measure.joints),
      stream_(std::move(stream)),
      colours_(make_overlay_colours(spec)) {}

void OverlayDecorator::on_gop(const Mesh&, const PlayerGop& gop) {
  colours_->begin_gop(
      {gop.info.first_frame, gop.info.frame_count, {{}, joints_ ? &joints_->skeleton : nullptr}});
}

void OverlayDecorator::on_frame(PlayerFrame& frame) {
  std::string problem;
  try {
    OverlayFrame shown{frame.number,     *frame.mesh, frame.positions,
                       frame.gop->flags, {},          frame.gop->keeps_vertex_order};
    if (joints_ && overlay_ == Overlay::kCost) shown.joints = joints_at(*joints_, frame.number, stream_);
    colours_->colour(shown, frame.values);
  } catch (const cli::ToolError& error) {
    frame.values.clear();
    problem = error.what();
  }
  const std::lock_guard lock(mutex_);
  problem_ = problem;
}

Legend OverlayDecorator::legend() const {
  Legend legend = colours_->legend();
  if (overlay_ == Overlay::kCost) legend.note = "of the GOP before until a GOP is whole";
  if (overlay_ == Overlay::kError) legend.note = colours_->scale_note() + " any frame so far";
  return legend;
}

std::string OverlayDecorator::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

}  // namespace tvg::player
