#pragma once
#include "player/overlay/overlay_colours.hpp"
#include "player/overlay/reference_frames.hpp"
#include "player/render/render_options.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace tvg::player {

/// The frames that `tvg render` shows, coloured by its overlay, and beside them those of the reference.
/// Broken input and sequences that do not fit together are ToolErrors.
class OverlayFrames {
 public:
  explicit OverlayFrames(const RenderOptions& options);

  /// Goes back to the first frame; false where an input can be read only once.
  bool rewind();
  /// Reads the next frame, and the reference's of the same number.
  bool next();
  const ShownFrame& frame() const { return frame_; }
  /// Valid until the next frame is read.
  const ShownFrame& reference() const { return *reference_frame_; }

  /// Fixes what the last colour stands for: the user's choice, or else what was measured so far, over all
  /// frames (`complete`) or the first alone.
  void keep_scale(bool complete);

  cli::ColourMap map() const { return colour_map_of(options_.overlay); }
  /// What the colours mean, after keep_scale(); nothing without an overlay.
  const std::optional<Legend>& legend() const { return legend_; }

  Metadata metadata() const { return frames_->metadata(); }
  std::vector<double> times() const { return frames_->times(); }
  std::string note() const { return frames_->note(); }
  /// Number of frames that next() gives, where it is known before the end.
  std::optional<std::uint64_t> wanted() const;

 private:
  const RenderOptions& options_;
  std::shared_ptr<ReferenceFrames> references_;
  std::unique_ptr<OverlayColours> colours_;
  std::unique_ptr<ShownFrames> frames_;
  ShownFrame frame_;
  const ShownFrame* reference_frame_ = nullptr;
  std::optional<Legend> legend_;
};

}  // namespace tvg::player
