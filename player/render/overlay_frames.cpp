#include "player/render/overlay_frames.hpp"

#include "player/overlay/overlay_values.hpp"
#include "player/render/whole_gops.hpp"

#include <fmt/format.h>
#include <utility>

namespace tvg::player {

namespace {

std::string scale_note(const OverlayColours& colours, const RenderOptions& options, bool complete) {
  if (options.largest) return "scale as given";
  return colours.scale_note() + (complete ? " any frame" : " the first frame");
}

}  // namespace

OverlayFrames::OverlayFrames(const RenderOptions& options) : options_(options) {
  const bool cost = options.overlay == Overlay::kCost;
  frames_ = open_frames({options.inputs, options.frames, options.overlay == Overlay::kImportance, cost,
                         options.conceal, options.open_inputs, options.lod, options.measure.joints,
                         !options.plain});
  if (!options.reference.empty()) {
    references_ = std::make_shared<ReferenceFrames>(ShownFramesSpec{options.reference,
                                                                    options.frames,
                                                                    false,
                                                                    false,
                                                                    options.conceal,
                                                                    options.open_source,
                                                                    0,
                                                                    {},
                                                                    !options.plain},
                                                    options.inputs.front());
  }
  colours_ = make_overlay_colours({options.overlay, options.largest, references_, options.measure});
  if (cost) frames_ = with_whole_gops(std::move(frames_), options.frames, *colours_);
}

bool OverlayFrames::rewind() {
  return frames_->rewind() && (!references_ || references_->rewind());
}

std::optional<std::uint64_t> OverlayFrames::wanted() const {
  if (options_.frames) return options_.frames->last - options_.frames->first + 1;
  return frames_->total();
}

bool OverlayFrames::next() {
  if (!frames_->next(frame_)) return false;
  if (references_) reference_frame_ = &references_->at(frame_.number);
  if (!colours_) return true;
  OverlayFrame frame{
      frame_.number, *frame_.mesh, frame_.positions, {}, frame_.joints, frames_->keeps_vertex_order()};
  if (frame_.flags) frame.flags = *frame_.flags;
  colours_->colour(frame, frame_.values);
  return true;
}

void OverlayFrames::keep_scale(bool complete) {
  if (!colours_) return;
  colours_->keep_scale();
  Legend legend = colours_->legend();
  if (options_.overlay != Overlay::kImportance) legend.note = scale_note(*colours_, options_, complete);
  if (options_.overlay == Overlay::kError) legend.units = short_units(frames_->metadata());
  legend_ = std::move(legend);
}

}  // namespace tvg::player
