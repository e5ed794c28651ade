#pragma once
#include "player/playback/player_frame.hpp"
#include "player/view/look.hpp"
#include "player/view/text_layer.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tvg::cli {

/// Values for an overlay, made in the decoding thread, and the legend that explains them.
class OverlayDecorator : public FrameDecorator {
 public:
  /// May be called while frames are being decorated.
  virtual Legend legend() const = 0;
};

/// The decorator of an overlay; null for kNone. `reference` are the inputs that kError compares with, a .tvg
/// or what `open_source` takes. Throws ToolError where they cannot be opened.
std::shared_ptr<OverlayDecorator> make_overlay_decorator(Overlay overlay,
                                                         const std::vector<std::string>& reference,
                                                         SourceOpener open_source);

}  // namespace tvg::cli
