#include "player/window/overlay_decorator.hpp"

#include "tool/tool_error.hpp"

namespace tvg::cli {

OverlayDecorator::OverlayDecorator(const OverlaySpec& spec)
    : overlay_(spec.overlay), colours_(make_overlay_colours(spec)) {}

void OverlayDecorator::on_gop(const Mesh&, const PlayerGop& gop) {
  colours_->begin_gop({gop.info.first_frame, gop.info.frame_count, {}});
}

void OverlayDecorator::on_frame(PlayerFrame& frame) {
  std::string problem;
  try {
    colours_->colour(
        {frame.number, *frame.mesh, frame.positions, frame.gop->flags, frame.gop->keeps_vertex_order},
        frame.values);
  } catch (const ToolError& error) {
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
  const std::lock_guard lock(mutex_);
  if (!problem_.empty()) legend.note = problem_;
  return legend;
}

}  // namespace tvg::cli
