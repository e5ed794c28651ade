#pragma once
#include "player/playback/player_frame.hpp"
#include "player/view/text_layer.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvg::cli {

/// What colours the mesh in the window.
enum class Overlay { kNone, kImportance, kCost, kError };

/// The name by which the command line and the window know an overlay ("importance").
const char* overlay_name(Overlay overlay);
/// The overlay of that name. Throws ToolError (kUsage) that lists them.
Overlay parse_overlay(const std::string& name);

/// Values for an overlay, made in the decoding thread, and the legend that explains them.
class OverlayDecorator : public FrameDecorator {
 public:
  /// May be called while frames are being decorated.
  virtual Legend legend() const = 0;
};

/// The decorator of an overlay; null for kNone. `reference` are the inputs that kError compares with, as
/// `tvg compare` takes them. Throws ToolError where they cannot be opened.
std::shared_ptr<OverlayDecorator> make_overlay_decorator(Overlay overlay,
                                                         const std::vector<std::string>& reference);

}  // namespace tvg::cli
