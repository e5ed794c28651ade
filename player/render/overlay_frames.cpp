#include "player/render/overlay_frames.hpp"

#include "player/view/overlay.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

// Few vertices lie far above all others; the colours are for the rest.
constexpr double kShareBelowError = 0.999;
constexpr double kShareBelowCost = 0.95;

}  // namespace

OverlayFrames::OverlayFrames(const RenderOptions& options) : options_(options) {
  const bool cost = options.overlay == Overlay::kCost;
  frames_ = open_frames({options.inputs, options.frames, options.overlay == Overlay::kImportance, cost,
                         options.conceal, options.open_source});
  if (cost) frames_ = with_cost(std::move(frames_), options.frames);
  if (!options.reference.empty()) {
    references_ =
        open_frames({options.reference, options.frames, false, false, options.conceal, options.open_source});
  }
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
  if (references_) read_reference();
  if (options_.overlay == Overlay::kError) add_error();
  if (largest_) scale();
  return true;
}

void OverlayFrames::read_reference() {
  if (references_->next(reference_frame_)) return;
  throw ToolError(ExitStatus::kInvalidInput,
                  fmt::format("{} ends before frame {}, which {} has: a reference needs every frame that is "
                              "shown",
                              options_.reference.back(), frame_.number, options_.inputs.front()));
}

void OverlayFrames::add_error() {
  if (frames_->keeps_vertex_order() != references_->keeps_vertex_order()) {
    const bool decoded = references_->keeps_vertex_order();
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("--overlay error: {} gave up the order of its vertices, so that none can be "
                                "found in {}",
                                (decoded ? options_.inputs : options_.reference).front(),
                                (decoded ? options_.reference : options_.inputs).front()));
  }
  if (frame_.positions.size() != reference_frame_.positions.size()) {
    throw ToolError(
        ExitStatus::kInvalidInput,
        fmt::format("{} has {} vertices and {} has {} at frame {}: errors are between frames of "
                    "one mesh",
                    options_.inputs.front(), frame_.mesh->vertex_count, options_.reference.front(),
                    reference_frame_.mesh->vertex_count, frame_.number));
  }
  frame_.values.resize(frame_.mesh->vertex_count);
  error_values(frame_.positions, reference_frame_.positions, frame_.values);
}

void OverlayFrames::measure() {
  if (frame_.values.empty() || options_.overlay == Overlay::kImportance) return;
  const double share = options_.overlay == Overlay::kCost ? kShareBelowCost : kShareBelowError;
  measured_ = std::max(measured_, value_at_share(frame_.values, share, scratch_));
}

void OverlayFrames::set_scale(bool complete) {
  if (options_.overlay == Overlay::kNone) return;
  largest_ = options_.overlay == Overlay::kImportance ? 1.0F
             : options_.largest                       ? static_cast<float>(*options_.largest)
                                                      : measured_;
  make_legend(complete);
  scale();
}

void OverlayFrames::scale() {
  scale_values(frame_.values, {0, *largest_});
}

void OverlayFrames::make_legend(bool complete) {
  Legend legend;
  legend.map = map();
  legend.largest = double{*largest_};
  const char* where = complete ? "any frame" : "the first frame";
  switch (options_.overlay) {
    case Overlay::kImportance:
      legend.title = "importance";
      legend.flagged = "important (fine lattice)";
      legend.plain = "other (coarse lattice)";
      break;
    case Overlay::kCost:
      legend.title = kCostTitle;
      legend.note = options_.largest ? "scale as given" : fmt::format("95 % of {}", where);
      break;
    default: {
      legend.title = "distance to the reference";
      legend.note = options_.largest ? "scale as given" : fmt::format("99.9 % of {}", where);
      const Metadata metadata = frames_->metadata();
      const auto units = metadata.find("units");
      if (units != metadata.end() && units->second.size() <= 12) legend.units = units->second;
    }
  }
  legend_ = legend;
}

}  // namespace tvg::cli
