#pragma once
#include "player/render/render_options.hpp"
#include "player/render/shown_frames.hpp"
#include "player/view/text_layer.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace tvg::cli {

/// The frames that `tvg render` shows, with the values of its overlay, and beside them those of the
/// reference. Broken input and sequences that do not fit together are ToolErrors.
class OverlayFrames {
 public:
  explicit OverlayFrames(const RenderOptions& options);

  /// Goes back to the first frame; false where an input can be read only once.
  bool rewind();
  /// Reads the next frame, and the reference's of the same number. Values are in the overlay's units until
  /// set_scale(), between 0 and 1 after it.
  bool next();
  const ShownFrame& frame() const { return frame_; }
  const ShownFrame& reference() const { return reference_frame_; }

  /// Takes the present frame's values into account for the scale.
  void measure();
  /// Fixes what the last colour stands for: the user's choice, or else what was measured, over all frames
  /// (`complete`) or the first alone. Applies to the present frame as well.
  void set_scale(bool complete);

  ColourMap map() const {
    return options_.overlay == Overlay::kImportance ? ColourMap::kFlags : ColourMap::kViridis;
  }
  /// What the colours mean, after set_scale(); nothing without an overlay.
  const std::optional<Legend>& legend() const { return legend_; }

  Metadata metadata() const { return frames_->metadata(); }
  /// Number of frames that next() gives, where it is known before the end.
  std::optional<std::uint64_t> wanted() const;

 private:
  void read_reference();
  void add_error();
  void scale();
  void make_legend(bool complete);

  const RenderOptions& options_;
  std::unique_ptr<ShownFrames> frames_, references_;
  ShownFrame frame_, reference_frame_;
  std::vector<float> scratch_;
  float measured_ = 0;
  std::optional<float> largest_;
  std::optional<Legend> legend_;
};

}  // namespace tvg::cli
